#pragma once
// One step of several, in the progress of them all.

#include "stone/progress/progress.h"

namespace culet {

/// Tells of a step that goes from one fraction of the whole to another. `progress` must outlive it.
inline Progress part_of(const Progress& progress, double from, double to) {
    if (!progress) return {};
    return [=, &progress](double done) { return progress(from + (to - from) * done); };
}

}  // namespace culet
