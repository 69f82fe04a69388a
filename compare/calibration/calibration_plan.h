#pragma once
// What a budget of work allows a calibration: how fine its pictures are, and how many it draws.

#include "compare/calibration/draft_renderer.h"

namespace culet {

struct CalibrationPlan {
    DraftRenderer renderer;  ///< of all its pictures
    int rounds = 8;          ///< draws at each facet error; nulls have three times as many
    bool tilts = true;       ///< whether what each facet's tilt changes is drawn
};

/// Of the pictures that are tried, the finest with which four rounds fit into `allowed_ns`, else as
/// many rounds as the coarsest allow, two at least. Work is counted, so that the plan is the same
/// on every machine. `allowed_ns` of 0: no limit, the finest. `photometric`: whether the photograph
/// serves for photometry; the facets' tilts are not read from one that does not.
CalibrationPlan plan_calibration(const Scene& model, const DraftRenderer& fine, int most_rounds,
                                 double allowed_ns, bool photometric);

}  // namespace culet
