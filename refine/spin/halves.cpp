#include "refine/spin/halves.h"

#include <algorithm>
#include <cmath>

#include "stone/numbers/units.h"
#include "stone/numbers/upper_median.h"

namespace culet {

namespace {

constexpr double k_told = radians(2.0);
// Facets further apart are different ones.
constexpr double k_same = radians(4.0);
// The median length of a random vector of two components, each of sigma 1.
const double k_median_length = std::sqrt(2 * std::log(2.0));
constexpr double k_small = 0.25 / 49, k_large = 2.0 / 49;  // of the width's square

struct SameFacet {
    int facet = 0;                // of the first
    double apart = 0, sigma = 0;  // the larger sigma
};

std::vector<SameFacet> same_facets(const std::vector<Vec3>& one, const std::vector<double>& sigmas,
                                   const std::vector<Vec3>& other,
                                   const std::vector<double>& other_sigmas) {
    std::vector<SameFacet> pairs;
    for (std::size_t f = 0; f < one.size(); ++f) {
        SameFacet pair{int(f), k_same, HUGE_VAL};
        for (std::size_t g = 0; g < other.size(); ++g) {
            const double angle = angle_between(one[f], other[g]);
            if (angle < pair.apart) pair = {int(f), angle, std::max(sigmas[f], other_sigmas[g])};
        }
        if (pair.sigma < k_told) pairs.push_back(pair);
    }
    return pairs;
}

std::vector<Vec3> normals_of(const TurningFit& fit) {
    std::vector<Vec3> normals;
    for (const Facet& facet : fit.solid.facets) normals.push_back(facet.plane.normal);
    return normals;
}

std::vector<Vec3> normals_of(const StandingStone& stone) {
    std::vector<Vec3> normals;
    for (const Facet& facet : stone.solid.facets)
        normals.push_back(stone.on_turntable(facet.plane.normal));
    return normals;
}

ComparedFacets from_size(const std::vector<SameFacet>& pairs, const Solid& solid, double least) {
    std::vector<double> tilts;
    for (const SameFacet& pair : pairs) {
        if (area(solid, solid.facets[std::size_t(pair.facet)]) >= least)
            tilts.push_back(pair.apart);
    }
    if (tilts.empty()) return {};
    return {int(tilts.size()), upper_median(tilts)};
}

}  // namespace

double factor_of_halves(const TurningFit& one, const TurningFit& other) {
    std::vector<double> parts;
    for (const SameFacet& pair :
         same_facets(normals_of(one), one.tilt_sigmas, normals_of(other), other.tilt_sigmas))
        parts.push_back(pair.apart / (std::sqrt(2.0) * pair.sigma));
    return parts.empty() ? 1 : std::max(1.0, upper_median(parts) / k_median_length);
}

void compare_stones(const StandingStone& one, const StandingStone& other, Halves& halves) {
    const auto pairs =
        same_facets(normals_of(one), one.tilt_sigmas, normals_of(other), other.tilt_sigmas);
    const auto a = proportions_of(one, 0), b = proportions_of(other, 0);
    const double width = a.front().value;
    halves.facets = from_size(pairs, one.solid, k_small * width * width);
    halves.large_facets = from_size(pairs, one.solid, k_large * width * width);
    halves.up = angle_between(one.at.z, other.at.z);
    for (const SpinProportion& p : a) {
        if (const SpinProportion* q = proportion(b, p.name))
            halves.proportions.emplace_back(p.name, p.value - q->value);
    }
}

}  // namespace culet
