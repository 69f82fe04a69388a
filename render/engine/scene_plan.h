#pragma once
// Only what a scene calls for: which effects it needs, with which settings drawing begins, and what
// leaving out the rest may cost in accuracy.
//
// Errors are means over the stone's pixels of the mean absolute difference of R, G and B to the
// picture with everything on, relative to the mean radiance of that picture. Bounds are those of
// the table in docs/plan.md: exactly zero where nothing can change; else the smaller of what is
// known beforehand and of what a pilot picture shows, with three standard errors. A pilot can miss
// a light that none of its rays meet; `verify` looks at the finished picture.

#include <limits>
#include <string>
#include <vector>

#include "render/scene/scene.h"

namespace culet {

/// One line of the plan: an effect, or how finely something is resolved.
struct PlanItem {
    /// An effect's name (scene.h); or depth, wavelengths, samples, light_edges,
    /// environment_filter, objects.
    std::string name;
    bool on = false;
    std::string fidelity;  ///< "both waves, each its own way", "15 wavelengths", ...; empty: off
    std::string why;       ///< "garnet is isotropic", "bound 0.0004 under tolerance 0.01", ...
    /// Of the error that remains, as planned: of leaving it out where it is off, of its fidelity
    /// where it is on. Coherence: of adding the two waves' powers, were they to interfere. NaN: not
    /// known.
    double bound = 0;
    double bound_delta_e = 0;  ///< the same as CIEDE2000, mean
    /// What the picture would be off by without it, as the pilot sees it; NaN: not looked at.
    double matters = 0;
    double matters_delta_e = 0;
    /// Estimated time of the picture, as planned but with this on or off. Processor time, seconds.
    double seconds_with = 0, seconds_without = 0;
};

struct ScenePlan {
    double tolerance = 0;  ///< that was asked for
    /// The scene's settings with every open choice made: of the first picture, or of the one that
    /// was kept, which a scene with these draws again. Their tolerance is that of the beams.
    RenderSettings settings;
    std::vector<PlanItem> items;  ///< the effects in the order of `Effects`, then the rest
    std::string engine_why;
    /// Of all together, but for samples, beams, and what the scene settles itself: effects that it
    /// switches off, and whether the two waves of a crystal interfere.
    double bound = 0, bound_delta_e = 0;
    double bound_of_sampling = 0;   ///< the reference's: of few rays in a pixel
    double bound_of_depth = 0;      ///< in `bound`: of the depth that the scene names
    double seconds = 0;             ///< estimated processor time of the picture
    double seconds_everything = 0;  ///< the same with everything on, by the reference
    double seconds_planning = 0;    ///< that this plan took
    double mean_radiance = 0;       ///< of the stone, as the pilot sees it
    double events_per_ray = 1;      ///< faces that light meets
    double pixels = 0;              ///< of the stone, estimated
    /// Of the stone and its light (fingerprint.h): another's plan is of no use.
    std::string stone_and_light;
    /// Error bound of the picture that was drawn with these settings and held against the truth;
    /// NaN: none was.
    double checked_bound = std::numeric_limits<double>::quiet_NaN();
    int pilot_pixels = 0;  ///< 0: nothing was open, or tolerance 0: no pilot

    const PlanItem& item(const std::string& name) const;
};

}  // namespace culet
