#pragma once
// Pictures from coarse to fine, each held against the truth, until one is near enough: previews,
// beams, the reference (refinement_levels.h).

#include <optional>

#include "render/beams/frame_renderer.h"
#include "render/engine/render_result.h"
#include "render/engine/scene_plan.h"
#include "render/planner/error_estimate.h"
#include "render/planner/refinement_levels.h"

namespace culet {

struct RefinedPicture {
    RenderResult result;
    bool near_enough = false;
    bool misjudged = false;  ///< not for its beams: the plan left out more than it saw
};

class Refinement {
public:
    /// Both must outlive it; the scene has a meter.
    Refinement(const Scene& scene, const Progress& progress)
        : scene_(scene), drawn_(scene), progress_(progress) {}

    /// The nearest of the pictures drawn, with the effects of the plan. Where the scene's meter has
    /// a limit, the reference takes the rays that are left of it. Throws Interrupted, and
    /// OverBudget where it allows none.
    RefinedPicture draw(ScenePlan plan, ErrorEstimator& estimator);

private:
    struct SoFar {
        std::optional<RenderResult> best;
        RefinementLevel level;  // of it
        double bound_delta_e = 0;
        bool blind = false;  // it may miss the sun
        bool near_enough = false, misjudged = false;
        int pixels_without = 0;  // at which the truth was drawn without what the plan left out
        double off_without = 0;
        double seconds = 0;
        void take(RenderResult result, const RefinementLevel& drawn, const ErrorEstimate& estimate,
                  bool may_be_blind);
    };
    void refine(const ScenePlan& plan, ErrorEstimator& estimator, const RefinementLevels& levels,
                SoFar& so_far);
    RenderResult draw_with(const RenderSettings& settings);
    bool misjudged(const ErrorEstimate& estimate, ErrorEstimator& estimator,
                   const RenderSettings& settings, SoFar& so_far) const;

    const Scene& scene_;
    Scene drawn_;
    const Progress& progress_;
    std::optional<FrameRenderer> frames_;
};

/// Of all that a picture took.
double seconds_of(const RenderStats& stats);

}  // namespace culet
