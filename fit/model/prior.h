#pragma once
// The prior of the facets before anything is read: they lie near the start, and the facets of a
// tier are alike. A Gaussian prior in two levels (a random-effects model). Each tier's common
// angle, azimuth and offset deviate from the start with the tiers' sigmas; each facet deviates from
// its tier with the facets' sigmas.
//
// The sigmas of angles are estimated from the readings (analysis of variance); the stated ones
// count like a few observations (a scaled inverse chi-square prior). Offsets, which no bench reads,
// keep the stated sigmas.

#include <array>
#include <functional>
#include <vector>

#include "fit/model/options.h"
#include "fit/model/shape.h"
#include "fit/readings/measurement.h"
#include "fit/readings/named_tiers.h"

namespace culet {

/// The errors that an equation of the prior describes.
enum class PriorLevel { tier_angle, facet_angle, tier_offset, facet_offset };
inline constexpr std::size_t k_prior_levels = 4;
using PriorSigmas = std::array<double, k_prior_levels>;  ///< radians and half diameters

/// One facet's angle, azimuth or offset relative to the start, without its tier's common part.
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

/// Makes the prior of an upright shape (half diameter 1) whose facets have the names of `solid`,
/// and appends the tiers' unknowns to its extras. `half_width`: of the stone, in half diameters.
PriorModel make_prior(const Prior& prior, const Solid& solid, int up_facet, double half_width,
                      Shape& shape);

/// Adjusts the readings' sigmas for use beside a prior. A file's row that gives one value to
/// several facets (`S*`) tells their mean, not that they are alike: each of its n readings gets
/// sqrt(n) times the sigma, so that together they determine the mean as well as the row does. Exact
/// meets are an idealisation: a reading of a facet's direction also gets the error that a real
/// meet's miss (`meet_miss`, half diameters) causes over the facet's size.
void count_beside_prior(const Shape& shape, const Solid& solid, double meet_miss,
                        const std::function<double(const Reading&)>& unit_of,
                        std::vector<Reading>& readings);

/// Estimates the angles' sigmas from the inclinations read, one value for each facet or row.
void estimate_angle_sigmas(const Solid& solid, const std::vector<Reading>& readings,
                           PriorModel& model);

}  // namespace culet
