#pragma once
// Stones as they might be by the uncertainty of a fit.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "render/optics/random.h"
#include "render/uncertainty/facet_attitudes.h"

namespace culet {

/// How sure one facet is: standard uncertainties of inclination and azimuth (radians) and of its
/// distance from the stone's middle (the solid's unit). 0: known exactly.
struct FacetUncertainty {
    double inclination = 0, azimuth = 0, offset = 0;
};

struct StoneUncertainty {
    std::vector<FacetUncertainty> facets;  ///< in the solid's order
    /// Covariance of all of them, row by row, three a facet; empty: facets are independent.
    std::vector<double> covariance;
    /// Facets whose inclination or offset nobody knows, and which count as known exactly.
    int unknown = 0;
    bool correlated() const { return !covariance.empty(); }
};

/// For the facets that `solid` has, out of those of its mesh, of which the planes may have left
/// some no room. `covariance`: of all of the mesh's facets, row by row, three a facet, or empty.
/// What is not finite is not known and counts as 0. Throws InputError where `solid` has a facet
/// that is not in `names`.
StoneUncertainty uncertainty_for(const Solid& solid, const std::vector<std::string>& names,
                                 const std::vector<FacetUncertainty>& sigmas,
                                 const std::vector<double>& covariance);

/// Draws convex stones around `solid` (its up direction +z), normally distributed; the same ones
/// for the same seed.
class StoneDraws {
public:
    /// `uncertainty`: of every facet of `solid`, which must outlive this.
    StoneDraws(const Solid& solid, const StoneUncertainty& uncertainty, std::uint64_t seed);
    /// Nothing where the drawn planes bound no stone.
    std::optional<Solid> next();

private:
    const Solid& solid_;
    Vec3 middle_;
    std::vector<FacetAttitude> truth_;
    std::vector<double> spread_;  // makes unit normal numbers into errors; row by row
    Random random_;
};

}  // namespace culet
