#pragma once
// The series of refinement levels: preview, finer and finer beams, the reference with more and more
// rays (policy.h). The error of beams halves per level, so it tells how many to skip. The truth's
// own rays show the reference's noise.

#include <optional>
#include <string>

#include "render/engine/scene_plan.h"
#include "render/planner/error_estimate.h"

namespace culet {

struct RefinementLevel {
    int number = 0;  ///< level within its engine
    RenderSettings settings;
    double price_ns = 0;  ///< estimate (price.h)
    double noise = 0;     ///< estimated error of the reference's few rays
    std::string why = {};
};

class RefinementLevels {
public:
    /// `scene`: one window, with the settings of its file. `plan`: with the effects to draw. All
    /// must outlive it.
    RefinementLevels(const Scene& scene, const ScenePlan& plan, ErrorEstimator& estimator);

    /// The coarsest beams if they can draw the scene, else the reference.
    RefinementLevel first() const;
    /// The level after `level`, given its picture's error: finer beams, or the reference if
    /// cheaper; after the reference, more rays. Empty if the scene forbids it or none is left.
    std::optional<RefinementLevel> after(const RefinementLevel& level,
                                         const ErrorEstimate& estimate) const;
    /// The reference's finest level up to `level` at that price; empty if one ray is too much.
    std::optional<RefinementLevel> within(const RefinementLevel& level, double allowed_ns) const;
    /// Whether all check pixels may miss a sun's images: a preview's regions lie beside those that
    /// show it, and few wavelengths lack some images.
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
    OpticalSetup setup_;  // of the effects to draw
    bool branches_;       // light paths branch into trees
};

}  // namespace culet
