#pragma once
// All jobs of a batch in one table.

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace culet {

/// How many jobs ended how.
struct BatchCounts {
    std::size_t good = 0, untrusted = 0, failed = 0, missing = 0;

    std::size_t all() const { return good + untrusted + failed + missing; }
};

struct MergedBatch {
    BatchCounts counts;
    /// `NAME: message` of those that failed or should not be trusted, in their order.
    std::vector<std::string> complaints;
};

/// Reads the plan and the records of the finished jobs, and writes table.csv, table.json and
/// index.html beside them. The same results give the same bytes, whoever made them and when. Throws
/// InputError: no folder of a batch, or not writable.
MergedBatch merge_batch(const std::filesystem::path& folder);

}  // namespace culet
