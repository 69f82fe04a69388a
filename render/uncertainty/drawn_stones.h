#pragma once
// Draws stones from the uncertainty of a fit.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "render/optics/random.h"
#include "render/uncertainty/facet_attitudes.h"

namespace culet {

/// Standard uncertainties of one facet's inclination and azimuth (radians) and of its distance from
/// the stone's middle (the solid's unit). 0: known exactly.
struct FacetUncertainty {
    double inclination = 0, azimuth = 0, offset = 0;
};

struct StoneUncertainty {
    std::vector<FacetUncertainty> facets;  ///< in the solid's order
    /// Covariance of all of them, row by row, three per facet; empty: facets are independent.
    std::vector<double> covariance;
    /// Number of facets with an unknown sigma of inclination or offset, which counts as 0.
    int unknown = 0;
    bool correlated() const { return !covariance.empty(); }
};

/// Picks the values of `solid`'s facets from those of its mesh, some of which the planes may have
/// cut away. `covariance`: of all the mesh's facets, row by row, three per facet, or empty. Values
/// that are not finite are unknown and count as 0. Throws InputError if `names` lacks a facet of
/// `solid`.
StoneUncertainty uncertainty_for(const Solid& solid, const std::vector<std::string>& names,
                                 const std::vector<FacetUncertainty>& sigmas,
                                 const std::vector<double>& covariance);

/// Draws convex stones around `solid` (up is +z) from a normal distribution, reproducibly by seed.
class StoneDraws {
public:
    /// `uncertainty`: of every facet of `solid`. `solid` must outlive this.
    StoneDraws(const Solid& solid, const StoneUncertainty& uncertainty, std::uint64_t seed);
    /// Nothing if the drawn planes bound no stone.
    std::optional<Solid> next();

private:
    const Solid& solid_;
    Vec3 middle_;
    std::vector<FacetAttitude> truth_;
    std::vector<double> spread_;  // transforms independent unit normals to errors; row by row
    Random random_;
};

}  // namespace culet
