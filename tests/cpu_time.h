#pragma once
// Measures work: processor time of all threads of this process, and elapsed time.

#include <time.h>

#include <algorithm>

namespace culet {

struct Clocks {
    double cpu = 0, wall = 0;  ///< seconds
};

inline Clocks clocks() {
    const auto read = [](clockid_t which) {
        timespec t{};
        clock_gettime(which, &t);
        return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
    };
    return {read(CLOCK_PROCESS_CPUTIME_ID), read(CLOCK_MONOTONIC)};
}

/// The least time of several runs, separately for each clock, because other load can only add. Runs
/// at least `least` times, and until `seconds` have passed.
template <class Work>
Clocks quickest(const Work& work, int least, double seconds) {
    Clocks best{1e300, 1e300};
    const Clocks first = clocks();
    for (int i = 0; i < least || clocks().wall - first.wall < seconds; ++i) {
        const Clocks start = clocks();
        work();
        const Clocks end = clocks();
        best.cpu = std::min(best.cpu, end.cpu - start.cpu);
        best.wall = std::min(best.wall, end.wall - start.wall);
    }
    return best;
}

}  // namespace culet
