#pragma once
// What culet batch is to do: stones by name, from a folder or a table.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/program/options.h"

namespace culet {

struct BatchJob {
    std::string name;      ///< of its folder: a plain file name in UTF-8, unlike every other job's
    std::string stone;     ///< file, as seen from the batch's folder
    std::string material;  ///< empty: the batch's, else the stone's own
    std::optional<double> index;  ///< likewise
    std::vector<std::string> set;
};

/// The same for every stone of a batch.
struct BatchSettings {
    std::string material, tilts = "-30:30:10";
    std::optional<double> index;
    double head_deg = 10;
    int draws = 0;  ///< stones drawn for the sigmas of a grade; 0: no sigmas
    bool pages = false;
    std::uint64_t seed = 1;
    std::vector<std::string> set;
};

struct BatchList {
    std::filesystem::path folder;      ///< stones are seen from here
    std::vector<BatchJob> jobs;        ///< in the order of their file names or of the table's rows
    std::vector<std::string> skipped;  ///< files of the folder that are no jobs, and why
    std::vector<std::string> notes;    ///< names that were shortened
};

/// A folder: a job for each stone file, cut design and mesh in it, but not for meshes that its
/// stone files name. A table (.csv): a job for each row (docs/batch.md). Throws InputError: no
/// jobs, or a table that names no stone, a name that is no file name, or a name twice.
BatchList read_batch(const std::filesystem::path& jobs);

}  // namespace culet
