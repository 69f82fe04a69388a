#pragma once
// The jobs of culet batch: named stones, from a folder or a table.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/program/options.h"

namespace culet {

struct BatchJob {
    std::string name;      ///< of its folder: a plain file name in UTF-8, unique in the batch
    std::string stone;     ///< file, relative to the batch's folder
    std::string material;  ///< empty: the batch's, else the stone's own
    std::optional<double> index;  ///< likewise
    std::vector<std::string> set;
};

/// The same for every stone of a batch.
struct BatchSettings {
    std::string material, tilts = "-30:30:10";
    std::optional<double> index;
    double head_deg = 10;
    int draws = 0;  ///< stones drawn at random for the sigmas of a grade; 0: no sigmas
    bool pages = false;
    std::uint64_t seed = 1;
    std::vector<std::string> set;
};

struct BatchList {
    std::filesystem::path folder;      ///< stones' paths are relative to it
    std::vector<BatchJob> jobs;        ///< in the order of their file names or of the table's rows
    std::vector<std::string> skipped;  ///< files of the folder that are not jobs, and why
    std::vector<std::string> notes;    ///< names that were shortened
};

/// A folder has a job for each stone file, cut design and mesh, but not for meshes that its stone
/// files name. A table (.csv) has one per row (docs/batch.md). Throws InputError when there are no
/// jobs, a row has no stone, or a name is no file name or occurs twice.
BatchList read_batch(const std::filesystem::path& jobs);

}  // namespace culet
