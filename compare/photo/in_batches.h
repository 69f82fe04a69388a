#pragma once
// Parallel loops that report progress. Private to the folder, because it exposes TBB.

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>

#include "stone/progress/progress.h"
#include "stone/text/errors.h"

namespace culet {

/// Runs `work(i)` for each i below `count` on `threads` (0: one for each processor), in batches, so
/// that this thread can report progress. Throws Interrupted.
template <class Work>
void in_batches(std::size_t count, int threads, const Progress& progress, const Work& work) {
    tbb::task_arena arena(threads > 0 ? threads : tbb::task_arena::automatic);
    const auto batch = static_cast<std::size_t>(std::max(2, 2 * arena.max_concurrency()));
    for (std::size_t first = 0; first < count; first += batch) {
        const std::size_t last = std::min(count, first + batch);
        arena.execute([&] { tbb::parallel_for(first, last, work); });
        if (progress && !progress(static_cast<double>(last) / static_cast<double>(count)))
            throw Interrupted();
    }
}

}  // namespace culet
