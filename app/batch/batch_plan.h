#pragma once
// What a batch's results depend on: its plan as text, the files of a stone, fingerprints.

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "app/batch/batch_jobs.h"

namespace culet {

/// The plan as it is kept in the results: settings and jobs, no paths but those of the jobs.
std::string batch_plan_json(const BatchList& list, const BatchSettings& settings);
/// The jobs' names, from such a plan; `file` is for messages. Throws InputError.
std::vector<BatchJob> jobs_of_plan(const std::string& json, const std::filesystem::path& file);

/// A stone's file and those that it names, and that they name: every text in a TOML file that is a
/// file as seen from there. Sorted; `set` as for --set. What cannot be read is left out.
std::vector<std::filesystem::path> files_of_stone(const std::filesystem::path& file,
                                                  const std::vector<std::string>& set);

/// Of a text: 16 hexadecimal digits (FNV-1a, 64 bits).
std::string hash_of(std::string_view text);

/// Changes with every byte that the job's results depend on: the version, the settings, the stone's
/// file and the files that it names. 16 hexadecimal digits (FNV-1a, 64 bits).
std::string fingerprint_of(const BatchList& list, const BatchJob& job,
                           const BatchSettings& settings);

}  // namespace culet
