#pragma once
// What the cut says before anything was read: facets lie near where the start has them, and the
// facets of a tier are alike. A Gaussian prior in two levels (a random-effects model): of each tier
// the angle, azimuth and offset it has in common are off the start by errors with the tiers'
// sigmas, and each facet is off its tier by errors with the facets' sigmas. The sigmas of angles
// are those that the readings show (analysis of variance), where the stated ones count like a few
// observations (a scaled inverse chi-square prior); those of offsets, which no bench reads, are the
// stated ones.

#include <array>
#include <functional>
#include <vector>

#include "fit/model/options.h"
#include "fit/model/shape.h"
#include "fit/readings/measurement.h"
#include "fit/readings/named_tiers.h"

namespace culet {

/// Whose errors an equation of the prior speaks of.
enum class PriorLevel { tier_angle, facet_angle, tier_offset, facet_offset };
inline constexpr std::size_t k_prior_levels = 4;
using PriorSigmas = std::array<double, k_prior_levels>;  ///< radians and half diameters

/// One facet's angle, azimuth or offset beside the start, less what its tier has in common.
struct PriorTerm {
    enum class Of { inclination, azimuth, offset, level_x, level_y } of = Of::inclination;
    int facet = -1;
    int extra = -1;    ///< the tier's common part, an extra unknown of the shape; -1: no tier
    double start = 0;  ///< radians or half diameters
    int side = 1;      ///< of an inclination: counted from up (1) or down (-1)
    bool is_angle() const { return of != Of::offset; }
};

struct PriorModel {
    std::vector<PriorTerm> terms;
    std::vector<int> angle_extras, azimuth_extras, offset_extras;  ///< of the tiers
    PriorSigmas sigmas{};
    double azimuth_ratio = 1;  ///< sigma of azimuths over that of inclinations
    bool empty() const { return terms.empty(); }
};

/// The prior of an upright shape (half diameter 1) whose facets are named as in `solid`; the tiers'
/// unknowns are appended to its extras. `half_width`: of the stone in half diameters.
PriorModel make_prior(const Prior& prior, const Solid& solid, int up_facet, double half_width,
                      Shape& shape);

/// Readings as they count beside a prior. A row of a file that gives one value to several facets
/// (`S*`) tells what they have in common, not that they are alike: each of its n readings gets
/// sqrt(n) times the sigma, so that together they know their mean as well as the row does. And
/// where the fit's meets are exact the true stone's are not: a reading of a facet's direction is
/// off by what a real meet misses over the facet's size, `meet_miss` in half diameters.
void count_beside_prior(const Shape& shape, const Solid& solid, double meet_miss,
                        const std::function<double(const Reading&)>& unit_of,
                        std::vector<Reading>& readings);

/// What the inclinations that were read, each of one facet or one row, say of the angles' sigmas.
void estimate_angle_sigmas(const Solid& solid, const std::vector<Reading>& readings,
                           PriorModel& model);

}  // namespace culet
