#pragma once
// Reports one of several steps as a part of the whole progress.

#include "stone/progress/progress.h"

namespace culet {

/// Maps a step's progress to the range `from` .. `to` of the whole. `progress` must outlive it.
inline Progress part_of(const Progress& progress, double from, double to) {
    if (!progress) return {};
    return [=, &progress](double done) { return progress(from + (to - from) * done); };
}

}  // namespace culet
