#pragma once

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <utility>

namespace culet {

/// Runs `work` so that its parallel loops use `threads` threads (0: one per processor). More
/// threads than processors are allowed, without TBB's warning on stderr.
template <class Work>
void on_threads(int threads, Work&& work) {
    const int most = static_cast<int>(
        tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
    const tbb::global_control allow(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(std::max({most, threads, 1})));
    tbb::task_arena arena(threads > 0 ? threads : tbb::task_arena::automatic);
    arena.execute(std::forward<Work>(work));
}

}  // namespace culet
