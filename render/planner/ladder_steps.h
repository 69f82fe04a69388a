#pragma once
// The steps of the ladder: with which settings drawing begins, and how it goes on where a picture
// was not near enough.

#include <string>

#include "render/engine/render_result.h"
#include "render/engine/scene_plan.h"
#include "render/planner/error_estimate.h"

namespace culet {

class CausePilot;

struct Step {
    RenderSettings settings;
    double price_ns = 0;  ///< about (price.h)
    double noise = 0;     ///< about what the reference's few rays are off by
    std::string why = {};
};

class LadderSteps {
public:
    /// `scene`: one window, with the settings that its file has; `plan`: with the effects that are
    /// to be drawn. All must outlive it.
    LadderSteps(const Scene& scene, const ScenePlan& plan, ErrorEstimator& estimator,
                const Progress& progress);

    /// The coarsest beams, where the scene can be drawn by them; else the reference with as few
    /// rays as may do.
    Step first() const;
    /// With rays for what the truth shows of their noise.
    Step by_reference(const ErrorEstimate* estimate) const;
    Step more_rays(const Step& step, const ErrorEstimate& estimate) const;
    /// What the picture is off by has causes that the pixels of its check tell apart: wavelengths,
    /// cut paths, and the rest, which is that of borders. Each is made so much finer that it is
    /// likely small enough. `again`: finer beams were drawn before, and were not near enough
    /// either: then all of it is.
    Step finer_beams(const Step& step, const ErrorEstimate& estimate, bool again) const;
    /// A sun's images in a few pixels are so coarse in this picture that those looked at may all
    /// miss them: a preview's regions lie beside those that show it, and few wavelengths lack some.
    bool may_miss_the_sun(const RenderSettings& settings) const;
    /// What a picture is off by, as far as the truth's noise lets it be seen.
    static double seen(const ErrorEstimate& estimate);

private:
    Scene with_effects() const;
    bool wavelengths_are_open() const;
    Step first_beams() const;
    // Wavelengths leave a path in ways so far apart that so many are known to be too few.
    bool too_few(int wavelengths) const;
    double finer_wavelengths(Step& step, CausePilot& pilot, bool again) const;
    double finer_cut(Step& step, CausePilot& pilot) const;
    double finer_borders(Step& step, double off_by) const;

    const Scene& scene_;
    const ScenePlan& plan_;
    ErrorEstimator& estimator_;
    const Progress& progress_;
    OpticalSetup setup_;  // of the effects to be drawn
    bool doubles_;        // trees of light paths do
};

}  // namespace culet
