#pragma once
// The levels of refinement: with which settings a picture is drawn first, and which come after one
// that was not near enough.
//
// What a picture of beams is off by has causes that the pixels of its check tell apart:
// wavelengths, cut paths, and the rest, which is that of borders. Each is made so much finer that
// it is likely small enough. The reference takes as many rays as bring its noise, which the
// truth's own rays show, to half the tolerance.

#include <optional>
#include <string>

#include "render/engine/scene_plan.h"
#include "render/planner/error_estimate.h"

namespace culet {

class CausePilot;

struct RefinementLevel {
    RenderSettings settings;
    double price_ns = 0;  ///< about (price.h)
    double noise = 0;     ///< about what the reference's few rays are off by
    std::string why = {};
};

class RefinementLevels {
public:
    /// `scene`: one window, with the settings that its file has; `plan`: with the effects that are
    /// to be drawn. All must outlive it.
    RefinementLevels(const Scene& scene, const ScenePlan& plan, ErrorEstimator& estimator,
                     const Progress& progress);

    /// The coarsest beams, where the scene can be drawn by them; else the reference.
    RefinementLevel first() const;
    /// After `level`, whose picture was off by what the estimate says: finer beams, or the
    /// reference where that costs less; the reference with more rays. Nothing: the scene, or sense,
    /// forbids it.
    /// `again`: finer beams were drawn before, and were not near enough either: then all of it is
    /// made finer.
    std::optional<RefinementLevel> after(const RefinementLevel& level,
                                         const ErrorEstimate& estimate, bool again) const;
    /// The reference with as many rays as a price allows, where that is less. False: not even one.
    bool fit(RefinementLevel& level, double allowed_ns) const;
    /// A sun's images in a few pixels are so coarse in this picture that those looked at may all
    /// miss them: a preview's regions lie beside those that show it, and few wavelengths lack some.
    bool may_miss_the_sun(const RenderSettings& settings) const;

private:
    Scene with_effects() const;
    bool wavelengths_are_open() const;
    RefinementLevel first_beams() const;
    RefinementLevel by_reference(const ErrorEstimate* estimate) const;
    RefinementLevel more_rays(const RefinementLevel& level, const ErrorEstimate& estimate) const;
    void set_rays(RefinementLevel& level, int rays) const;
    RefinementLevel finer_beams(const RefinementLevel& level, const ErrorEstimate& estimate,
                                bool again) const;
    double finer_wavelengths(RefinementLevel& level, CausePilot& pilot, bool again) const;
    double finer_cut(RefinementLevel& level, CausePilot& pilot) const;
    double finer_borders(RefinementLevel& level, double off_by) const;
    // Wavelengths leave a path in ways so far apart that so many are known to be too few.
    bool too_few(int wavelengths) const;
    int rays_to_reach(double room, int rays, double off) const;

    const Scene& scene_;
    const ScenePlan& plan_;
    ErrorEstimator& estimator_;
    const Progress& progress_;
    OpticalSetup setup_;  // of the effects to be drawn
    bool doubles_;        // trees of light paths do
};

}  // namespace culet
