#pragma once
// Optimises a cut's angles while keeping its meets (docs/optimize.md).

#include <optional>
#include <string>
#include <vector>

#include "render/optimize/merit.h"
#include "render/optimize/tier_design.h"
#include "stone/progress/progress.h"

namespace culet {

struct OptimizeLimits {
    double range = radians(8);  ///< largest change of a tier's angle
    /// Pavilion facets steeper than the critical angle stay steeper by at least this.
    double over_critical = 0;
    double least_volume = 0.8;  ///< relative to the start's, for the same outline
    /// Width of the table relative to the stone's, each the mean of x and y.
    double least_table = 0, most_table = 1;
};

/// For recutting a fitted stone: the better cut must fit inside it without rotation.
struct Recut {
    double gain = 0;         ///< least gain of merit, in points; 0: as much as `most_loss` allows
    double most_loss = 0.1;  ///< of the stone's volume
};

struct OptimizeOptions {
    MeritOptions merit;
    OptimizeLimits limits;
    std::optional<Recut> recut;
    int evaluations = 400;  ///< of the merit, approximately
};

struct OptimizedTier {
    FacetTier tier;
    double from = 0, to = 0;  ///< mean angles from the horizontal, radians
};

struct Optimized {
    Solid start, better;  ///< better: equals the start if nothing better was found
    Merit at_start, at_better;
    /// Best result of GemRay's search: Nelder-Mead on a factor for the tangents of all crown angles
    /// and one for all pavilion angles (R. W. Strickland, GemRay 1.2.0).
    Merit by_two_factors;
    std::vector<OptimizedTier> tiers;
    double volume_ratio = 1;  ///< better over start; for a recut, the part of the stone that
                              ///< remains
    int evaluations = 0;
    Vec3 axis{0};  ///< for a recut: position of the better cut's origin (its axis)
    bool found = false;
    bool gained = true;        ///< for a recut: whether the requested gain was reached
    bool interrupted = false;  ///< by `progress`; the result is the best so far
};

/// `solid`: closed and convex, table up. Throws InputError for others, and if no angle can change.
/// All facets stay, and so does the drawing's symmetry about +z. The result does not depend on the
/// number of threads.
Optimized optimize_cut(const Solid& solid, const OptimizeOptions& options,
                       const Progress& progress = {});

/// The better cut about its axis, as designs are written.
Solid about_its_axis(const Optimized& result);

/// Width of the table relative to the stone's, the mean of x and y.
double table_share(const Solid& solid);

}  // namespace culet
