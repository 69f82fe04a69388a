#pragma once
// Better angles for a cut, its meets kept (docs/optimize.md).

#include <optional>
#include <string>
#include <vector>

#include "render/optimize/merit.h"
#include "render/optimize/tier_design.h"
#include "stone/progress/progress.h"

namespace culet {

struct OptimizeLimits {
    double range = radians(8);  ///< most change of a tier's angle
    /// Pavilion facets that stand steeper than the critical angle stay steeper by at least this.
    double over_critical = 0;
    double least_volume = 0.8;  ///< of the start's, the outline being the same
    /// The table's width over the stone's, each the mean of x and y.
    double least_table = 0, most_table = 1;
};

/// A fitted stone is cut anew: the better cut must fit inside it, not turned.
struct Recut {
    double gain = 0;         ///< least merit won, in points; 0: as much as `most_loss` allows
    double most_loss = 0.1;  ///< of the stone's volume
};

struct OptimizeOptions {
    MeritOptions merit;
    OptimizeLimits limits;
    std::optional<Recut> recut;
    int evaluations = 400;  ///< of the merit, about
};

struct OptimizedTier {
    FacetTier tier;
    double from = 0, to = 0;  ///< mean angles from the horizontal, radians
};

struct Optimized {
    Solid start, better;  ///< better: the start where nothing better was found
    Merit at_start, at_better;
    /// Best of the search that GemRay makes: Nelder-Mead on two factors, of the tangents of all
    /// crown and of all pavilion angles (R. W. Strickland, GemRay 1.2.0).
    Merit by_two_factors;
    std::vector<OptimizedTier> tiers;
    double volume_ratio = 1;  ///< better over start; of a recut what is left of the stone
    int evaluations = 0;
    Vec3 axis{0};              ///< of a recut: where the better cut's origin, its axis, came to lie
    bool found = false;        ///< whether anything better was
    bool gained = true;        ///< of a recut: whether the wanted gain was reached
    bool interrupted = false;  ///< by `progress`: the best until then
};

/// `solid`: closed and convex, table up; throws InputError for others and where no angle can
/// change. Every facet stays, and so does the symmetry about +z that the drawing has. The result
/// does not depend on the number of threads.
Optimized optimize_cut(const Solid& solid, const OptimizeOptions& options,
                       const Progress& progress = {});

/// The better cut as a design is written: about its axis, wherever a recut stone has it.
Solid about_its_axis(const Optimized& result);

/// The table's width over the stone's, the mean of those along x and along y.
double table_share(const Solid& solid);

}  // namespace culet
