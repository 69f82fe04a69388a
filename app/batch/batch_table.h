#pragma once
// Merges all jobs of a batch into one table.

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace culet {

struct BatchCounts {
    std::size_t good = 0, untrusted = 0, failed = 0, missing = 0;

    std::size_t all() const { return good + untrusted + failed + missing; }
};

struct MergedBatch {
    BatchCounts counts;
    /// `NAME: message` for jobs that failed or should not be trusted, in the jobs' order.
    std::vector<std::string> complaints;
};

/// Writes table.csv, table.json and index.html from the plan and the finished jobs' records. The
/// same results give the same bytes. Throws InputError when the folder is not a batch's or not
/// writable.
MergedBatch merge_batch(const std::filesystem::path& folder);

}  // namespace culet
