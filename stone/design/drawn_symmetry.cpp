#include "stone/design/drawn_symmetry.h"

#include <algorithm>
#include <boost/math/special_functions/beta.hpp>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>

#include "stone/solid/angles.h"
#include "stone/solid/caliper.h"
#include "stone/solid/checks.h"

namespace culet {

namespace {

// A round stone misses its symmetry by 1 % (rms of corners, half diameter 1), an oval of 1.2 to 1
// the round one's by 9 %.
constexpr double k_near = 0.05;
// The error of two decimals of a degree over a facet's reach of a quarter of the diameter.
constexpr double k_digits = 1e-4;
// Facets share corners, so F scatters more than for independent ones. Of 40 brilliants with corners
// off by 0.01 of 6.5 mm, 14 lose their mirrors at a level of 1 %, and 4 at this one.
constexpr double k_level = 1e-4;
// A motion that moves corners by more sigmas than this was not meant, even in a rough drawing.
constexpr double k_rough = 4;

// What the facets of one orbit share, with weights for corners of equal uncertainty.
struct Place {
    double tilt = 0, radius = 0, height = 0;
    double tilt_weight = 0, weight = 0;
};

// Inverse variance of a facet's tilt for corners with unit variance along the normal (least-squares
// plane; slender facets are well known along, badly across).
double tilt_weight(const Solid& solid, const Facet& facet, const Vec3& up) {
    const Vec3& n = facet.plane.normal;
    const Vec3 level = glm::cross(up, n);
    const Vec3 across = glm::length(level) > 1e-9 ? glm::normalize(level) : plan_frame(up).x;
    const Vec3 down = glm::cross(n, across), middle = corner_mean(solid, facet);
    double downs = 0, acrosses = 0, both = 0;
    for (const int c : facet.corners) {
        const Vec3 r = solid.vertices[std::size_t(c)] - middle;
        const double d = glm::dot(r, down), a = glm::dot(r, across);
        downs += d * d;
        acrosses += a * a;
        both += d * a;
    }
    return acrosses > 0 ? std::max(0.0, downs - both * both / acrosses) : 0;
}

std::vector<Place> places_of(const Solid& solid, const Vec3& up, const Vec3& middle) {
    std::vector<Place> places;
    for (const Facet& facet : solid.facets) {
        const Vec3 r = corner_mean(solid, facet) - middle;
        const double height = glm::dot(r, up);
        places.push_back({std::acos(std::clamp(glm::dot(facet.plane.normal, up), -1.0, 1.0)),
                          glm::length(r - height * up), height, tilt_weight(solid, facet, up),
                          double(facet.corners.size())});
    }
    return places;
}

struct Misfit {
    double squares = 0, degrees_of_freedom = 0;
    double variance() const { return degrees_of_freedom > 0 ? squares / degrees_of_freedom : 0; }
};

Misfit misfit_of(const AxisGroup& group, const std::vector<Place>& places) {
    Misfit misfit;
    const auto add = [&](const FacetOrbit& orbit, double Place::*what, double Place::*weight) {
        double sum = 0, mean = 0;
        for (const int f : orbit.facets) {
            const Place& p = places[std::size_t(f)];
            sum += p.*weight;
            mean += p.*weight * p.*what;
        }
        if (!(sum > 0)) return;
        mean /= sum;
        for (const int f : orbit.facets) {
            const Place& p = places[std::size_t(f)];
            misfit.squares += p.*weight * std::pow(p.*what - mean, 2);
        }
        misfit.degrees_of_freedom += double(orbit.facets.size()) - 1;
    };
    for (const FacetOrbit& orbit : orbits_of(group, places.size())) {
        if (orbit.facets.size() < 2) continue;
        add(orbit, &Place::tilt, &Place::tilt_weight);
        add(orbit, &Place::radius, &Place::weight);
        add(orbit, &Place::height, &Place::weight);
    }
    return misfit;
}

// k corners have k - 3 degrees of freedom off their facet's plane.
Misfit curvature_misfit(const Solid& solid) {
    Misfit bends;
    for (const Facet& facet : solid.facets) {
        for (const int c : facet.corners) {
            bends.squares += std::pow(
                glm::dot(facet.plane.normal, solid.vertices[std::size_t(c)]) - facet.plane.offset,
                2);
        }
        bends.degrees_of_freedom += double(facet.corners.size()) - 3;
    }
    return bends;
}

// P(F > f) of Fisher's distribution.
double f_tail(double f, double freedom, double other) {
    if (!(f > 0)) return 1;
    if (!(other > 0)) return 0;
    return boost::math::ibeta(other / 2, freedom / 2, other / (other + freedom * f));
}

class Search {
public:
    Search(const Solid& solid, const Vec3& up)
        : middle_(std::accumulate(solid.vertices.begin(), solid.vertices.end(), Vec3(0)) /
                  double(solid.vertices.size())),
          half_(0.5 * diameter(solid)),
          places_(places_of(solid, up, middle_)),
          curvatures_(curvature_misfit(solid)) {}

    double half() const { return half_; }
    double digits() const { return k_digits * half_; }
    double bend() const { return std::sqrt(curvatures_.variance()); }
    Misfit misfit(const AxisGroup& group) const { return misfit_of(group, places_); }

    bool is_near(const AxisGroup& group) const {
        const Misfit own = misfit(group);
        return own.variance() < std::pow(k_near * half_, 2) ||
               f_tail(own.variance() / curvatures_.variance(), own.degrees_of_freedom,
                      curvatures_.degrees_of_freedom) > k_level;
    }
    bool loses_nothing(const AxisGroup& group) const {
        const std::vector<AxisGroup> parts = subgroups_of(group);
        const Misfit all = misfit(group);
        const double digits2 = digits() * digits();
        return std::all_of(parts.begin(), parts.end(), [&](const AxisGroup& part) {
            const Misfit own = misfit(part);
            const double more = all.degrees_of_freedom - own.degrees_of_freedom;
            if (!(more > 0) || !(own.degrees_of_freedom > 0)) return true;
            const double f = (all.squares - own.squares) / more / (own.variance() + digits2);
            return f_tail(f, more, own.degrees_of_freedom) > k_level / double(parts.size());
        });
    }

private:
    Vec3 middle_;
    double half_;
    std::vector<Place> places_;
    Misfit curvatures_;
};

AxisGroup no_group(std::size_t facets) {
    AxisGroup none;
    none.elements.resize(1);
    none.elements[0].facets.resize(facets);
    std::iota(none.elements[0].facets.begin(), none.elements[0].facets.end(), 0);
    return none;
}

void find_groups(const Solid& solid, const Vec3& up, int table, const Search& search,
                 DrawnSymmetry& drawn) {
    std::vector<Automorphism> maps = automorphisms(solid);
    if (table >= 0) maps = that_keep(maps, table);
    const PlanFrame frame = plan_frame(up);
    std::vector<Vec3> points;
    for (const Vec3& v : solid.vertices) {
        points.push_back({glm::dot(v, frame.x), glm::dot(v, frame.y), glm::dot(v, up)});
    }
    const double limit = std::max(k_near * search.half(), k_rough * search.bend());
    const AxisGroup largest = largest_group(motions_about_z(maps, points), limit);
    if (largest.is_trivial()) return;
    for (AxisGroup& group : subgroups_of(largest)) {
        if (!search.is_near(group)) continue;
        if (drawn.near.is_trivial()) drawn.near = group;
        if (!search.loses_nothing(group)) continue;
        drawn.group = std::move(group);
        return;
    }
}

}  // namespace

double DrawnSymmetry::tilt_sigma(const Solid& solid, int facet, const Vec3& up) const {
    const double weight = tilt_weight(solid, solid.facets[std::size_t(facet)], up);
    return weight > 0 ? scatter / std::sqrt(weight) : std::numeric_limits<double>::infinity();
}

DrawnSymmetry drawn_symmetry(const Solid& solid, const Vec3& up, int table) {
    const AxisGroup none = no_group(solid.facets.size());
    DrawnSymmetry drawn{none, none, 0};
    if (solid.facets.empty() || !is_closed(solid)) return drawn;
    const Search search(solid, up);
    find_groups(solid, up, table, search, drawn);
    const Misfit own = search.misfit(drawn.group);
    drawn.scatter = std::hypot(
        own.degrees_of_freedom > 0 ? std::sqrt(own.variance()) : search.bend(), search.digits());
    return drawn;
}

}  // namespace culet
