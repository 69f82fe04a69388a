#pragma once
// The jobs of a share, each in a process of its own: what ends one, a crash too, ends no other.

#include "app/batch/batch_folder.h"
#include "app/batch/batch_jobs.h"

namespace culet {

struct ShareOptions {
    BatchShare share;
    int workers = 0;      ///< processes at a time; 0: as many as processors may be used
    bool resume = false;  ///< finished jobs stay, where their fingerprint is that of now
    bool quiet = false, verbose = false;
};

struct ShareResult {
    std::size_t worked = 0, kept = 0;
    std::size_t bad = 0;                  ///< of all: failed, or not to be trusted
    double seconds = 0, cpu_seconds = 0;  ///< of the clock, of all processes
};

/// Works on the share and leaves every job of it finished. For a process without threads: it forks.
/// Throws Interrupted, after its processes have ended and what they had begun is gone; and
/// InputError where results cannot be written, or are there already and `resume` is not asked for.
ShareResult work_on_share(const BatchList& list, const BatchSettings& settings,
                          const std::filesystem::path& out, const ShareOptions& options);

}  // namespace culet
