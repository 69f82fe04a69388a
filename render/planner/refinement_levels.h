#pragma once
// The levels of refinement, a fixed series: preview, beams finer and finer, and the reference with
// more and more rays (policy.h). An error halves from level to level of the beams, so that it tells
// how many to skip; the truth's own rays show how noisy the reference is with how many.

#include <optional>
#include <string>

#include "render/engine/scene_plan.h"
#include "render/planner/error_estimate.h"

namespace culet {

struct RefinementLevel {
    int number = 0;  ///< among those of its engine
    RenderSettings settings;
    double price_ns = 0;  ///< about (price.h)
    double noise = 0;     ///< about what the reference's few rays are off by
    std::string why = {};
};

class RefinementLevels {
public:
    /// `scene`: one window, with the settings that its file has; `plan`: with the effects that are
    /// to be drawn. All must outlive it.
    RefinementLevels(const Scene& scene, const ScenePlan& plan, ErrorEstimator& estimator);

    /// The coarsest beams, where the scene can be drawn by them; else the reference.
    RefinementLevel first() const;
    /// After `level`, whose picture was off by what the estimate says: finer beams, or the
    /// reference where that costs less; the reference with more rays. Nothing: the scene forbids
    /// it, or there is none.
    std::optional<RefinementLevel> after(const RefinementLevel& level,
                                         const ErrorEstimate& estimate) const;
    /// The reference's finest level up to `level` that a price allows; nothing: not even one ray.
    std::optional<RefinementLevel> within(const RefinementLevel& level, double allowed_ns) const;
    /// A sun's images in a few pixels are so coarse in this picture that those looked at may all
    /// miss them: a preview's regions lie beside those that show it, and few wavelengths lack some.
    bool may_miss_the_sun(const RenderSettings& settings) const;

private:
    Scene with_effects() const;
    bool wavelengths_are_open() const;
    RefinementLevel beams(int number) const;
    RefinementLevel reference(int number, double noise, int rays) const;
    RefinementLevel reference_by_noise(int least, double noise, int rays) const;
    bool too_few(int wavelengths) const;

    const Scene& scene_;
    const ScenePlan& plan_;
    ErrorEstimator& estimator_;
    OpticalSetup setup_;  // of the effects to be drawn
    bool doubles_;        // trees of light paths do
};

}  // namespace culet
