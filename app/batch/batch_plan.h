#pragma once
// What a batch's results depend on: its plan as text, a stone's files, fingerprints.

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "app/batch/batch_jobs.h"

namespace culet {

/// The plan as it is stored: settings and jobs, with no paths except the jobs'.
std::string batch_plan_json(const BatchList& list, const BatchSettings& settings);
/// `file` is for messages. Throws InputError.
std::vector<BatchJob> jobs_of_plan(const std::string& json, const std::filesystem::path& file);

/// A stone's file and all that it names, directly or through others: every text in a TOML file that
/// is a file relative to it. Sorted; `set` as for --set. Unreadable files are omitted.
std::vector<std::filesystem::path> files_of_stone(const std::filesystem::path& file,
                                                  const std::vector<std::string>& set);

/// Returns FNV-1a (64 bits) as 16 hexadecimal digits.
std::string hash_of(std::string_view text);

/// Hashes all that the job's results depend on: version, settings, the stone's file and the files
/// that it names. 16 hexadecimal digits.
std::string fingerprint_of(const BatchList& list, const BatchJob& job,
                           const BatchSettings& settings);

}  // namespace culet
