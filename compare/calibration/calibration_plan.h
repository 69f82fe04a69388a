#pragma once
// The resolution and number of a calibration's pictures within a time budget.

#include "compare/calibration/draft_renderer.h"

namespace culet {

struct CalibrationPlan {
    DraftRenderer renderer;  ///< of all its pictures
    int rounds = 8;          ///< draws at each facet error; nulls have three times as many
    bool tilts = true;       ///< whether facet tilts are drawn
};

/// Takes the finest resolution for which four rounds fit into `allowed_ns`, otherwise the coarsest
/// with as many rounds as fit, at least two. Work is counted, not timed, so the plan is the same on
/// every machine. `allowed_ns` 0: no limit. `photometric`: false for a photograph that cannot serve
/// for photometry; then facet tilts are not used.
CalibrationPlan plan_calibration(const Scene& model, const DraftRenderer& fine, int most_rounds,
                                 double allowed_ns, bool photometric);

}  // namespace culet
