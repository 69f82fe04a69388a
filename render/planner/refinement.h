#pragma once
// Draws and checks pictures from coarse to fine until one is close enough: previews, beams, the
// reference (refinement_levels.h).

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
    bool misjudged = false;  ///< the error comes from effects that the plan left out
};

class Refinement {
public:
    /// Both must outlive it; the scene must have a meter.
    Refinement(const Scene& scene, const Progress& progress)
        : scene_(scene), drawn_(scene), progress_(progress) {}

    /// Returns the closest picture with the plan's effects. If the meter has a limit, the reference
    /// uses the rays that are left. Throws Interrupted, and OverBudget if no work is left for one
    /// picture.
    RefinedPicture draw(ScenePlan plan, ErrorEstimator& estimator);

private:
    struct SoFar {
        std::optional<RenderResult> best;
        RefinementLevel level;  // of it
        double bound_delta_e = 0;
        bool blind = false;  // it may have missed the sun
        bool near_enough = false, misjudged = false;
        int pixels_without = 0;  // check pixels drawn without the effects left out
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

/// Total time that a picture took.
double seconds_of(const RenderStats& stats);

}  // namespace culet
