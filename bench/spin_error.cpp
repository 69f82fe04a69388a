#include "bench/spin_error.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "stone/numbers/units.h"
#include "stone/numbers/upper_median.h"

namespace culet::bench {

namespace {

constexpr double k_width_mm = 7, k_least_mm2 = 1, k_partner = radians(3);

Eigen::Vector3d eigen(const Vec3& v) {
    return {v.x, v.y, v.z};
}

// Rotates directions of the found stone into the turntable's frame: it brings the camera's axes of
// all frames, as the projections have them, nearest to the true ones (Kabsch 1976).
Eigen::Matrix3d to_truth(const SpinResult& found, const synthetic::SpinTruth& truth) {
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    for (std::size_t f = 0; f < found.frames.size(); ++f) {
        if (!found.frames[f].turn) continue;
        const auto& p = found.frames[f].projection;
        const PictureAxes at = picture_axes(truth.series.camera, truth.series.turns[f]);
        const Vec3 row0(p[0][0], p[0][1], p[0][2]), row1(p[1][0], p[1][1], p[1][2]),
            row2(p[2][0], p[2][1], p[2][2]);
        const Vec3 across = glm::normalize(row0 - p[0][3] * row2),
                   along = glm::normalize(p[1][3] * row2 - row1);
        sum +=
            eigen(at.across) * eigen(across).transpose() +
            eigen(at.along) * eigen(along).transpose() +
            eigen(glm::cross(at.across, at.along)) * eigen(glm::cross(across, along)).transpose();
    }
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(sum, Eigen::ComputeFullU | Eigen::ComputeFullV);
    Eigen::Matrix3d sense = Eigen::Matrix3d::Identity();
    sense(2, 2) = (svd.matrixU() * svd.matrixV().transpose()).determinant();
    return svd.matrixU() * sense * svd.matrixV().transpose();
}

double least_width(const Solid& solid, const Vec3& up) {
    double least = HUGE_VAL;
    const Vec3 x = glm::normalize(
                   glm::cross(std::abs(up.x) < 0.5 ? Vec3(1, 0, 0) : Vec3(0, 1, 0), up)),
               y = glm::cross(up, x);
    for (double a = 0; a < 180; a += 0.5)
        least = std::min(least,
                         width_along(solid, std::cos(radians(a)) * x + std::sin(radians(a)) * y));
    return least;
}

struct Pair {
    double angle = 0;
    std::size_t truth = 0, found = 0;
};

void compare_facets(const SpinResult& found, const synthetic::SpinTruth& truth,
                    const Eigen::Matrix3d& turn, double mm_per_px, SpinError& error) {
    std::vector<bool> is_seen(found.solid.facets.size(), true);
    for (const int f : found.unseen) is_seen[std::size_t(f)] = false;
    std::vector<Pair> pairs;
    for (std::size_t t = 0; t < truth.solid.facets.size(); ++t) {
        const Facet& facet = truth.solid.facets[t];
        if (area(truth.solid, facet) * mm_per_px * mm_per_px < k_least_mm2) continue;
        ++error.facets;
        for (std::size_t f = 0; f < found.solid.facets.size(); ++f) {
            const Eigen::Vector3d n = turn * eigen(found.solid.facets[f].plane.normal);
            const double angle = angle_between({n.x(), n.y(), n.z()}, facet.plane.normal);
            if (is_seen[f] && angle < k_partner) pairs.push_back({angle, t, f});
        }
    }
    std::sort(pairs.begin(), pairs.end(),
              [](const Pair& a, const Pair& b) { return a.angle < b.angle; });
    std::vector<bool> truth_done(truth.solid.facets.size()), found_done(is_seen.size());
    std::vector<double> angles;
    for (const Pair& p : pairs) {
        if (truth_done[p.truth] || found_done[p.found]) continue;
        truth_done[p.truth] = found_done[p.found] = true;
        angles.push_back(p.angle);
        error.within += p.angle < found.tilt_sigmas[p.found];
        error.tilt_rms += p.angle * p.angle;
        if (std::getenv("CULET_BENCH_FACETS") != nullptr) {
            const Facet& facet = truth.solid.facets[p.truth];
            fmt::print("   {:>4} {:6.2f} mm2 {:5.1f} deg up: {:.3f} +- {:.3f} deg\n", facet.name,
                       area(truth.solid, facet) * mm_per_px * mm_per_px,
                       degrees(std::asin(facet.plane.normal.z)), degrees(p.angle),
                       degrees(found.tilt_sigmas[p.found]));
        }
    }
    error.found = int(angles.size());
    error.tilt_rms = std::sqrt(error.tilt_rms / std::max(1, error.found));
    error.tilt_median = angles.empty() ? 0 : upper_median(std::move(angles));
}

void compare_table(const SpinResult& found, const synthetic::SpinTruth& truth,
                   const Eigen::Matrix3d& turn, SpinError& error) {
    const int mine = find_facet(found.solid, "T");
    if (mine < 0) return;
    const Facet& table = truth.solid.facets[std::size_t(find_facet(truth.solid, "T"))];
    const Eigen::Vector3d n = turn * eigen(found.solid.facets[std::size_t(mine)].plane.normal),
                          x = turn.col(0);
    error.table = angle_between({n.x(), n.y(), n.z()}, table.plane.normal);
    if (const SpinProportion* part = proportion(found.proportions, "table_pct"))
        error.table_part = part->value / 100;
    const Vec3 across(x.x(), x.y(), x.z());
    double least = HUGE_VAL, most = -HUGE_VAL;
    for (const int c : table.corners) {
        least = std::min(least, glm::dot(across, truth.solid.vertices[std::size_t(c)]));
        most = std::max(most, glm::dot(across, truth.solid.vertices[std::size_t(c)]));
    }
    error.true_table_part = (most - least) / width_along(truth.solid, across);
}

double turn_rms(const SpinResult& found, const synthetic::SpinTruth& truth) {
    std::vector<double> off;
    double mean = 0, squares = 0;
    for (std::size_t f = 0; f < found.frames.size(); ++f) {
        if (found.frames[f].turn) off.push_back(*found.frames[f].turn - truth.series.turns[f]);
    }
    for (const double o : off) mean += o / double(off.size());
    for (const double o : off) squares += (o - mean) * (o - mean);
    return std::sqrt(squares / std::max(1.0, double(off.size())));
}

}  // namespace

SpinError error_of(const SpinResult& found, const synthetic::SpinTruth& truth) {
    SpinError error;
    const Eigen::Matrix3d turn = to_truth(found, truth);
    const Facet& table = truth.solid.facets[std::size_t(find_facet(truth.solid, "T"))];
    compare_facets(found, truth, turn, k_width_mm / least_width(truth.solid, table.plane.normal),
                   error);
    compare_table(found, truth, turn, error);
    error.turn_rms = turn_rms(found, truth);
    return error;
}

}  // namespace culet::bench
