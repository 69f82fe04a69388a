#pragma once
// Runs the jobs of a share, each in its own process, so that a crash of one does not end the
// others.

#include "app/batch/batch_folder.h"
#include "app/batch/batch_jobs.h"

namespace culet {

struct ShareOptions {
    BatchShare share;
    int workers = 0;      ///< processes at a time; 0: one per usable processor
    bool resume = false;  ///< keep finished jobs whose fingerprint is up to date
    bool quiet = false, verbose = false;
};

struct ShareResult {
    std::size_t worked = 0, kept = 0;
    std::size_t bad = 0;                  ///< number that failed or should not be trusted, kept
                                          ///< ones included
    double seconds = 0, cpu_seconds = 0;  ///< wall clock; processor time of all processes
};

/// Leaves every job of the share finished. Forks, so the process must not have threads. Throws
/// Interrupted when its processes have ended and their unfinished work is gone, InputError when
/// results cannot be written, or exist and `resume` is false.
ShareResult work_on_share(const BatchList& list, const BatchSettings& settings,
                          const std::filesystem::path& out, const ShareOptions& options);

}  // namespace culet
