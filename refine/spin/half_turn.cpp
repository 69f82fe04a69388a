#include "refine/spin/half_turn.h"

#include <Eigen/Dense>
#include <cmath>
#include <map>
#include <string>

#include "stone/numbers/units.h"
#include "stone/numbers/upper_median.h"

namespace culet {

namespace {

// Facets of one pair differ by less, steps of one side by more.
constexpr double k_one_facet = radians(4);
// Tilts that are known worse are not copied.
constexpr double k_copied_sigma = radians(2.5);
// The axis is found by facets steeper than this: flat ones do not tell where it is.
constexpr double k_steepest_normal = 0.9;
constexpr int k_rounds = 20;
// Of the width: pairs of few sides do not tell where the axis is across them.
constexpr double k_off_middle = 0.1;
constexpr double k_agreement = 0.02;  // of the stone's width

struct Pair {
    Vec3 normal{0};
    double difference = 0;  // of the facets' offsets
};

Vec3 half_turned(const Vec3& v) {
    return {-v.x, -v.y, v.z};
}

// The shown facet nearest to a direction, -1: none within k_one_facet.
int facet_towards(const Solid& solid, const std::vector<bool>& shown, const Vec3& normal) {
    int nearest = -1;
    double least = k_one_facet;
    for (std::size_t f = 0; f < solid.facets.size(); ++f) {
        if (!shown[f]) continue;
        const double angle = angle_between(solid.facets[f].plane.normal, normal);
        if (angle >= least) continue;
        least = angle;
        nearest = int(f);
    }
    return nearest;
}

// The axis' place (x, y), at which difference = 2 normal . place for most pairs: least squares with
// Cauchy's weights about `scale`, at first about the stone's middle.
Eigen::Vector2d axis_of(const std::vector<Pair>& pairs, double scale,
                        const Eigen::Vector2d& middle) {
    Eigen::Vector2d axis = middle;
    for (int round = 0; round < k_rounds; ++round) {
        Eigen::Matrix2d left = Eigen::Matrix2d::Zero();
        Eigen::Vector2d right(0, 0);
        for (const Pair& pair : pairs) {
            const Eigen::Vector2d slope(2 * pair.normal.x, 2 * pair.normal.y);
            const double weight =
                1 / (1 + std::pow((pair.difference - slope.dot(axis)) / scale, 2));
            left += weight * slope * slope.transpose();
            right += weight * pair.difference * slope;
        }
        axis = left.ldlt().solve(right);
    }
    return axis;
}

Eigen::Vector2d middle_of(const Solid& solid) {
    Eigen::Vector2d least(HUGE_VAL, HUGE_VAL), most = -least;
    for (const Vec3& v : solid.vertices) {
        least = least.cwiseMin(Eigen::Vector2d(v.x, v.y));
        most = most.cwiseMax(Eigen::Vector2d(v.x, v.y));
    }
    return (least + most) / 2;
}

std::vector<Pair> pairs_of(const Solid& solid, const std::vector<bool>& shown) {
    std::vector<Pair> pairs;
    for (std::size_t f = 0; f < solid.facets.size(); ++f) {
        const Plane& plane = solid.facets[f].plane;
        if (!shown[f] || std::abs(plane.normal.z) > k_steepest_normal) continue;
        const int other = facet_towards(solid, shown, half_turned(plane.normal));
        if (other >= 0)
            pairs.push_back(
                {plane.normal, plane.offset - solid.facets[std::size_t(other)].plane.offset});
    }
    return pairs;
}

}  // namespace

std::optional<HalfTurned> completed_by_half_turn(const Solid& solid,
                                                 const std::vector<double>& tilt_sigmas,
                                                 const std::vector<bool>& shown) {
    const std::vector<Pair> pairs = pairs_of(solid, shown);
    const double agreement = k_agreement * width_along(solid, {1, 0, 0});
    if (int(pairs.size()) < 2 * k_least_pairs) return std::nullopt;
    const Eigen::Vector2d middle = middle_of(solid), axis = axis_of(pairs, agreement / 2, middle);
    if (!((axis - middle).norm() < k_off_middle * width_along(solid, {1, 0, 0})))
        return std::nullopt;
    std::vector<double> off;
    for (const Pair& pair : pairs)
        off.push_back(
            std::abs(pair.difference - 2 * (pair.normal.x * axis.x() + pair.normal.y * axis.y())));
    HalfTurned result;
    result.pairs =
        int(std::count_if(off.begin(), off.end(), [&](double d) { return d < agreement; })) / 2;
    result.axis_sigma = 1.4826 / 2 * upper_median(off);
    if (result.pairs < k_least_pairs) return std::nullopt;

    std::vector<NamedPlane> planes;
    std::map<std::string, double> sigmas;
    const auto add = [&](std::string name, const Plane& plane, double sigma) {
        sigmas[name] = sigma;
        planes.push_back({std::move(name), plane});
    };
    for (std::size_t f = 0; f < solid.facets.size(); ++f) {
        if (!shown[f]) continue;
        const Facet& facet = solid.facets[f];
        add(facet.name, facet.plane, tilt_sigmas[f]);
        const Vec3 normal = half_turned(facet.plane.normal);
        if (tilt_sigmas[f] > k_copied_sigma || facet_towards(solid, shown, normal) >= 0) continue;
        add(facet.name + "h",
            {normal, facet.plane.offset + 2 * (normal.x * axis.x() + normal.y * axis.y())},
            tilt_sigmas[f]);
    }
    result.solid = intersect_half_spaces(planes).solid;
    if (result.solid.facets.empty()) return std::nullopt;
    for (std::size_t f = 0; f < result.solid.facets.size(); ++f) {
        const std::string& name = result.solid.facets[f].name;
        result.tilt_sigmas.push_back(sigmas[name]);
        if (name.back() == 'h') result.copies.push_back(int(f));
    }
    return result;
}

}  // namespace culet
