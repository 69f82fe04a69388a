#pragma once
// Pictures from coarse to fine, each held against the truth, until one is near enough.
//
// A fixed ladder: previews, beams, the reference. How far up the next step goes, and with what, the
// pixels tell that were held against the truth (ladder_steps.h).

#include <optional>
#include <string>
#include <vector>

#include "render/beams/frame_renderer.h"
#include "render/engine/render_result.h"
#include "render/engine/scene_plan.h"
#include "render/planner/error_estimate.h"
#include "render/planner/ladder_steps.h"

namespace culet {

struct LadderPicture {
    RenderResult result;
    bool near_enough = false;
    bool misjudged = false;  ///< not for its beams: the plan left out more than it saw
};

class Ladder {
public:
    /// Both must outlive it; the scene has a meter.
    Ladder(const Scene& scene, const Progress& progress)
        : scene_(scene), drawn_(scene), progress_(progress) {}

    /// The nearest of the pictures drawn, with the effects of the plan, of which there are some at
    /// most, or those that the scene's meter allows. Throws Interrupted, and OverAllowance where it
    /// allows none.
    LadderPicture draw(ScenePlan plan, ErrorEstimator& estimator);

private:
    struct SoFar {
        std::optional<RenderResult> best;
        RenderSettings settings;  // of it
        std::string why;          // it was drawn so
        double noise = 0;
        double bound_delta_e = 0;
        bool blind = false;  // it may miss the sun
        bool near_enough = false, misjudged = false;
        int pixels_without = 0;  // at which the truth was drawn without what the plan left out
        double off_without = 0;
    };
    void climb(const ScenePlan& plan, ErrorEstimator& estimator, const LadderSteps& steps,
               SoFar& so_far);
    RenderResult draw_with(const RenderSettings& settings);
    ErrorEstimate held_against_truth(const RenderResult& result, ErrorEstimator& estimator,
                                     double price, double most_ns, double error_before);
    bool misjudged(const ErrorEstimate& estimate, const ErrorEstimator& estimator,
                   const RenderSettings& settings, SoFar& so_far) const;
    std::optional<Step> next(const LadderSteps& steps, const Step& step,
                             const ErrorEstimate& estimate, bool again) const;

    const Scene& scene_;
    Scene drawn_;
    const Progress& progress_;
    std::optional<FrameRenderer> frames_;
};

/// Of all that a picture took.
double seconds_of(const RenderStats& stats);

}  // namespace culet
