#include "refine/spin/form_axis.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "stone/numbers/units.h"

namespace culet {

namespace {

constexpr double k_one_place = radians(5.0);  // steps of one side are further apart
constexpr double k_mirror_step = radians(1.0), k_alike = radians(2.0), k_possible = 0.5;
// At first and then: sigma of a partner's offset, in the width; of its tilt.
constexpr std::array<double, 2> k_offsets{0.03, 0.005};
constexpr std::array<double, 2> k_tilts{radians(2.0), radians(1.0)};

template <class T>
using Vector = std::array<T, 3>;

template <class T>
T dot(const Vector<T>& a, const Vector<T>& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

template <class T>
Vector<T> cross(const Vector<T>& a, const Vector<T>& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

// `axis`: the members of FormAxis.
template <class T>
Vector<T> moved_normal(const T* axis, const FormMotion& motion, const Vec3& normal) {
    using std::cos, std::sin, std::sqrt;
    const T length = sqrt(axis[0] * axis[0] + axis[1] * axis[1] + T(1));
    const Vector<T> along{axis[0] / length, axis[1] / length, T(1) / length};
    Vector<T> n{T(normal.x), T(normal.y), T(normal.z)};
    if (motion.mirrored) {
        Vector<T> across{-sin(axis[4]), cos(axis[4]), T(0)};
        const T in_axis = dot(across, along);
        for (std::size_t i = 0; i < 3; ++i) across[i] -= in_axis * along[i];
        const T off = dot(across, n) / dot(across, across);
        for (std::size_t i = 0; i < 3; ++i) n[i] -= T(2) * off * across[i];
    }
    const double c = std::cos(motion.turn), s = std::sin(motion.turn);
    const Vector<T> around = cross(along, n);
    const T height = dot(along, n) * T(1 - c);
    for (std::size_t i = 0; i < 3; ++i) n[i] = T(c) * n[i] + T(s) * around[i] + height * along[i];
    return n;
}

std::array<double, 5> members(const FormAxis& axis) {
    return {axis.tilt_x, axis.tilt_y, axis.x, axis.y, axis.mirror};
}

struct PairMisfit {
    Plane one, other;
    FormMotion motion;
    double tilt = 1, offset = 1;

    template <class T>
    bool operator()(const T* axis, T* misfit) const {
        const Vector<T> n = moved_normal(axis, motion, one.normal);
        for (int i = 0; i < 3; ++i) misfit[i] = (n[std::size_t(i)] - other.normal[i]) / tilt;
        const auto from_axis = [&](const Plane& p) {
            return p.offset - p.normal.x * axis[2] - p.normal.y * axis[3];
        };
        misfit[3] = (from_axis(one) - from_axis(other)) / offset;
        return true;
    }
};

// Area of the facets that the motions take to others, as far as these are alike. `offset`: sigma of
// a partner's offset.
double likeness(const std::vector<Plane>& planes, const std::vector<double>& areas,
                const FormAxis& axis, const std::vector<FormMotion>& motions, double offset) {
    double sum = 0;
    for (std::size_t i = 0; i < planes.size(); ++i) {
        for (const FormMotion& motion : motions) {
            const Plane image = moved(axis, motion, planes[i]);
            const int other = plane_towards(planes, image.normal, k_one_place);
            if (other < 0) continue;
            const Plane& partner = planes[std::size_t(other)];
            const double tilt = angle_between(image.normal, partner.normal) / k_alike,
                         apart = (image.offset - partner.offset) / offset;
            sum += areas[i] * std::exp(-0.5 * (tilt * tilt + apart * apart));
        }
    }
    return sum;
}

// Where normals alone allow a mirror: a rectangle's may be those of a square.
std::vector<double> possible_mirrors(const std::vector<Plane>& planes,
                                     const std::vector<double>& areas, const FormAxis& axis,
                                     int order) {
    std::vector<double> alike;
    const double turn = std::numbers::pi / order;
    const auto steps = std::size_t(turn / k_mirror_step);
    FormAxis tried = axis;
    for (std::size_t k = 0; k < steps; ++k) {
        tried.mirror = turn * double(k) / double(steps);
        alike.push_back(likeness(planes, areas, tried, {{0, true}}, HUGE_VAL));
    }
    const double most = *std::max_element(alike.begin(), alike.end());
    std::vector<double> mirrors;
    for (std::size_t k = 0; k < steps; ++k) {
        if (alike[k] >= k_possible * most && alike[k] >= alike[(k + steps - 1) % steps] &&
            alike[k] > alike[(k + 1) % steps])
            mirrors.push_back(turn * double(k) / double(steps));
    }
    return mirrors;
}

FormAxis fitted_axis(const std::vector<Plane>& planes, const CutSymmetry& symmetry,
                     const std::vector<FormMotion>& motions, double width, FormAxis axis) {
    for (std::size_t round = 0; round < 2 * k_offsets.size(); ++round) {
        ceres::Problem problem;
        std::array<double, 5> values = members(axis);
        problem.AddParameterBlock(values.data(), 5);
        if (!symmetry.mirrors)
            problem.SetManifold(values.data(), new ceres::SubsetManifold(5, {4}));
        for (const Plane& plane : planes) {
            for (std::size_t m = 1; m < motions.size(); ++m) {
                const int other =
                    plane_towards(planes, moved(axis, motions[m], plane).normal, k_one_place);
                if (other < 0) continue;
                using Cost = ceres::AutoDiffCostFunction<PairMisfit, 4, 5>;
                problem.AddResidualBlock(
                    new Cost(new PairMisfit{plane, planes[std::size_t(other)], motions[m],
                                            k_tilts[round / 2], k_offsets[round / 2] * width}),
                    new ceres::CauchyLoss(1), values.data());
            }
        }
        if (problem.NumResidualBlocks() == 0) break;
        ceres::Solver::Options options;
        options.linear_solver_type = ceres::DENSE_QR;
        options.num_threads = 1;
        options.max_num_iterations = 200;
        options.function_tolerance = options.parameter_tolerance = 1e-14;
        options.gradient_tolerance = 1e-16;
        ceres::Solver::Summary summary;
        ceres::Solve(options, &problem, &summary);
        axis = {values[0], values[1], values[2], values[3], values[4]};
    }
    return axis;
}

}  // namespace

std::vector<FormMotion> motions_of(const CutSymmetry& symmetry) {
    std::vector<FormMotion> motions;
    for (const bool mirrored : {false, true}) {
        if (mirrored && !symmetry.mirrors) break;
        for (int k = 0; k < symmetry.order; ++k)
            motions.push_back({2 * std::numbers::pi * k / symmetry.order, mirrored});
    }
    return motions;
}

Plane moved(const FormAxis& axis, const FormMotion& motion, const Plane& plane) {
    const auto n = moved_normal(members(axis).data(), motion, plane.normal);
    const Vec3 normal{n[0], n[1], n[2]}, place{axis.x, axis.y, 0};
    return {normal, plane.offset + glm::dot(normal - plane.normal, place)};
}

int plane_towards(const std::vector<Plane>& planes, const Vec3& normal, double within) {
    int nearest = -1;
    for (std::size_t p = 0; p < planes.size(); ++p) {
        const double angle = angle_between(planes[p].normal, normal);
        if (angle >= within) continue;
        within = angle;
        nearest = int(p);
    }
    return nearest;
}

FormAxis axis_of(const std::vector<Plane>& planes, const std::vector<double>& areas,
                 const CutSymmetry& symmetry, const Vec3& middle, double width) {
    FormAxis start;
    start.x = middle.x;
    start.y = middle.y;
    const std::vector<FormMotion> motions = motions_of(symmetry);
    const std::vector<double> mirrors = symmetry.mirrors
                                            ? possible_mirrors(planes, areas, start, symmetry.order)
                                            : std::vector<double>{0};
    FormAxis best = start;
    double most = -1;
    for (const double mirror : mirrors) {
        start.mirror = mirror;
        const FormAxis axis = fitted_axis(planes, symmetry, motions, width, start);
        const double alike = likeness(planes, areas, axis, {motions.begin() + 1, motions.end()},
                                      k_offsets.back() * width);
        if (!(alike > most)) continue;
        most = alike;
        best = axis;
    }
    return best;
}

}  // namespace culet
