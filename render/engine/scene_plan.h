#pragma once
// The plan of a scene: the effects it needs, the settings of the first picture, and a bound on the
// error of omitting the rest.
//
// Errors are mean absolute differences of R, G and B over the stone's pixels from the picture with
// everything on, relative to its mean radiance. Bounds follow the table in docs/plan.md: zero where
// nothing can change; else the smaller of the a-priori bound and the pilot's error plus three
// standard errors. A pilot can miss a light that none of its rays meet; `verify` checks the
// finished picture.

#include <limits>
#include <string>
#include <vector>

#include "render/scene/scene.h"

namespace culet {

/// One line of the plan: an effect or a resolution.
struct PlanItem {
    /// An effect's name (scene.h); or depth, wavelengths, samples, light_edges,
    /// environment_filter, objects.
    std::string name;
    bool on = false;
    std::string fidelity;  ///< "both waves, each its own way", "15 wavelengths", ...; empty: off
    std::string why;       ///< "garnet is isotropic", "bound 0.0004 under tolerance 0.01", ...
    /// Bound on the remaining error: of omitting the effect if off, of its fidelity if on; for
    /// coherence, of adding the powers of waves that interfere. NaN: unknown.
    double bound = 0;
    double bound_delta_e = 0;  ///< the same as mean CIEDE2000
    /// Error of the picture without it, as seen by the pilot; NaN: not measured.
    double matters = 0;
    double matters_delta_e = 0;
    /// Estimated processor time of the planned picture with this on or off, in seconds.
    double seconds_with = 0, seconds_without = 0;
};

struct ScenePlan {
    double tolerance = 0;  ///< as asked for
    /// The scene's settings with every open choice made: of the first picture, or of the one that
    /// was kept, which these settings reproduce. `tolerance` is the beams'.
    RenderSettings settings;
    std::vector<PlanItem> items;  ///< the effects in the order of `Effects`, then the rest
    std::string engine_why;
    /// Of all effects together. Excludes sampling, beams, and decisions of the scene: effects it
    /// switches off, and whether a crystal's two waves interfere.
    double bound = 0, bound_delta_e = 0;
    double bound_of_sampling = 0;   ///< reference: error of few rays per pixel
    double bound_of_depth = 0;      ///< part of `bound`: error of the depth that the scene names
    double seconds = 0;             ///< estimated processor time of the picture
    double seconds_everything = 0;  ///< by the reference with everything on
    double seconds_planning = 0;    ///< spent on this plan
    double mean_radiance = 0;       ///< of the stone, as seen by the pilot
    double events_per_ray = 1;      ///< faces met
    double pixels = 0;              ///< of the stone, estimated
    /// Key of the stone and its light (fingerprint.h): the plan is valid for these only.
    std::string stone_and_light;
    /// Error bound of the picture drawn with these settings, as checked against the reference; NaN:
    /// none.
    double checked_bound = std::numeric_limits<double>::quiet_NaN();
    int pilot_pixels = 0;  ///< 0: no pilot (nothing was open, or the tolerance is 0)

    const PlanItem& item(const std::string& name) const;
};

}  // namespace culet
