#include "fit/silhouettes/outline_rows.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "fit/silhouettes/plane_body.h"
#include "fit/silhouettes/registration.h"
#include "stone/numbers/dense_algebra.h"
#include "stone/solid/perpendicular.h"

namespace culet {

namespace {

// A plane is unseen if its tilt's sigma is more than this part of its start's.
constexpr double k_unseen = 0.5;

// Steps of all planes under a rigid motion of the stone; offsets in widths.
Eigen::VectorXd motion_of(const std::vector<Plane>& planes, double width, const Vec3& turn,
                          const Vec3& shift) {
    Eigen::VectorXd step(3 * Eigen::Index(planes.size()));
    for (std::size_t p = 0; p < planes.size(); ++p) {
        const Vec3& n = planes[p].normal;
        const auto [t, u] = tilts_of(n);
        const Vec3 tilt = glm::cross(turn, n);
        const auto at = 3 * Eigen::Index(p);
        step(at) = glm::dot(t, tilt);
        step(at + 1) = glm::dot(u, tilt);
        step(at + 2) = glm::dot(n, shift) / width;
    }
    return step;
}

Eigen::MatrixXd undetermined_motions(const std::vector<Plane>& planes, double width, const Vec3& up,
                                     const FrameHolds& holds) {
    const Vec3 x = perpendicular_to(up), y = glm::cross(up, x), none(0);
    std::vector<Eigen::VectorXd> motions;
    for (const Vec3& d : {x, y, up}) motions.push_back(motion_of(planes, width, none, width * d));
    if (!holds.turn) motions.push_back(motion_of(planes, width, up, none));
    if (!holds.tilts) {
        motions.push_back(motion_of(planes, width, x, none));
        motions.push_back(motion_of(planes, width, y, none));
    }
    Eigen::MatrixXd all(motions[0].size(), Eigen::Index(motions.size()));
    for (std::size_t k = 0; k < motions.size(); ++k) all.col(Eigen::Index(k)) = motions[k];
    return all;
}

std::vector<int> unseen_planes(const Eigen::MatrixXd& matrix, const std::vector<double>& tilts) {
    const Eigen::MatrixXd covariance = Cholesky(matrix).inverse();
    std::vector<int> unseen;
    for (Eigen::Index p = 0; 3 * p < matrix.rows(); ++p) {
        const double variance = covariance(3 * p, 3 * p) + covariance(3 * p + 1, 3 * p + 1);
        const double start = tilts[std::size_t(p)];
        if (0.5 * variance > std::pow(k_unseen * start, 2)) unseen.push_back(int(p));
    }
    return unseen;
}

}  // namespace

OutlineRows outline_rows(const std::vector<Plane>& planes, const Eigen::MatrixXd& information,
                         const std::vector<double>& tilts, double width, const FrameMotion& back,
                         const FrameHolds& holds) {
    Eigen::MatrixXd matrix = information;
    for (Eigen::Index i = 2; i < matrix.rows(); i += 3) {
        matrix.row(i) *= width;
        matrix.col(i) *= width;
    }
    OutlineRows result;
    result.unseen = unseen_planes(matrix, tilts);
    const Vec3 up = inverse(back).turned(holds.up);
    const Eigen::MatrixXd motions = undetermined_motions(planes, width, up, holds);
    const Eigen::MatrixXd seen = product(matrix, motions);
    const PivotedCholesky of_motions(transpose_times(motions, seen));
    matrix -= product(seen, of_motions.solve(seen.transpose()));
    const PivotedCholesky factor(matrix);
    Eigen::MatrixXd half = factor.root();
    // Exact to rounding: the fit recognises by it that no row sees a motion.
    const PivotedCholesky lengths(transpose_times(motions, motions));
    half -= product(product(half, motions), lengths.solve(motions.transpose()));
    const Eigen::VectorXd& d = factor.pivots();
    // Drops directions known no better than to a radian or a width, and rounding errors.
    const double least = std::max(1.0, 1e-13 * d.maxCoeff());
    for (Eigen::Index k = 0; k < d.size(); ++k) {
        if (!(d(k) > least)) continue;
        const double root = std::sqrt(d(k));
        OutlineObservations::Row& row = result.rows.emplace_back();
        for (std::size_t p = 0; p < planes.size(); ++p) {
            const auto [t, u] = tilts_of(planes[p].normal);
            const auto at = 3 * Eigen::Index(p);
            const double offset = root * half(k, at + 2) / width;
            const Vec3 tilt = root * (half(k, at) * t + half(k, at + 1) * u);
            // In the stone's frame the offset grows by shift . normal.
            row.normal.push_back(back.turned(tilt) - offset * back.shift);
            row.offset.push_back(offset);
        }
    }
    return result;
}

}  // namespace culet
