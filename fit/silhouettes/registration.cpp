#include "fit/silhouettes/registration.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "stone/numbers/dense_algebra.h"

namespace culet {

namespace {

using Step = Eigen::Matrix<double, 7, 1>;  // shift, turn, logarithm of the scale
using Normal = Eigen::Matrix<double, 7, 7>;

constexpr int k_most_registration_steps = 60;
// Stop when a step gains less than this part of the cost.
constexpr double k_no_registration_gain = 1e-9;

Vec3 turned_about(const Vec3& v, const Vec3& turn) {
    const double angle = glm::length(turn);
    if (!(angle > 0)) return v;
    const Vec3 axis = turn / angle;
    return std::cos(angle) * v + std::sin(angle) * glm::cross(axis, v) +
           (1 - std::cos(angle)) * glm::dot(axis, v) * axis;
}

Vec3 middle(std::span<const Vec3> corners) {
    Vec3 sum(0);
    for (const Vec3& c : corners) sum += c / double(corners.size());
    return sum;
}

// Turns and scales about the placed middle, then shifts.
Similarity moved(const Similarity& at, const Vec3& middle, const Step& step) {
    Similarity next = at;
    const Vec3 turn(step(3), step(4), step(5));
    next.motion.x = glm::normalize(turned_about(at.motion.x, turn));
    next.motion.y = turned_about(at.motion.y, turn);
    next.motion.y =
        glm::normalize(next.motion.y - glm::dot(next.motion.x, next.motion.y) * next.motion.x);
    next.motion.z = glm::cross(next.motion.x, next.motion.y);
    next.scale = at.scale * std::exp(step(6));
    const Vec3 was = at.placed(middle);
    next.motion.shift =
        was + Vec3(step(0), step(1), step(2)) - next.motion.turned(next.scale * middle);
    return next;
}

class Registration {
public:
    Registration(std::span<const Vec3> corners, std::span<const FlatContour> contours,
                 const RegistrationOptions& options)
        : corners_(corners), contours_(contours), middle_(middle(corners)) {
        free_ = {options.shifts, options.shifts, options.shifts, options.turns,
                 options.turns,  options.turns,  options.scales};
    }

    Similarity run(Similarity at) {
        look(at);
        double damping = 1e-4;
        for (int i = 0; i < k_most_registration_steps && damping < 1e8; ++i) {
            const double scale = scale_, before = cost(scale);
            const Step step = solved(scale, damping);
            const Similarity next = moved(at, middle_, step);
            look(next);
            const double after = cost(scale);
            if (after < before) {
                at = next;
                damping = std::max(1e-9, damping / 5);
                if (before - after < k_no_registration_gain * before && scale_ > 0.999 * scale)
                    break;
            } else {
                look(at);
                damping *= 10;
            }
        }
        return at;
    }

    double cost_at(const Similarity& at, double scale) {
        look(at);
        return cost(scale);
    }

private:
    void look(const Similarity& at) {
        placed_ = placed_corners(corners_, at);
        distances_ = outline_distances(placed_, contours_, {std::vector<FrameMotion>(1), {}});
        scale_ = robust_scale(distances_, contours_, 0);
    }

    // Bounded: points beyond `k_sure` scales count as if they were there.
    double cost(double scale) const {
        const double most = std::pow(k_sure * scale, 2);
        double sum = 0;
        for (std::size_t c = 0; c < contours_.size(); ++c) {
            for (std::size_t i = 0; i < contours_[c].points.size(); ++i) {
                const double d = distances_.nearest[c][i].distance;
                sum += std::min(contours_[c].weights[i] * d * d, most);
            }
        }
        return sum;
    }

    Step solved(double scale, double damping) const {
        Normal normal = Normal::Zero();
        Step gradient = Step::Zero();
        const Vec3 centre = middle(placed_);
        for (std::size_t c = 0; c < contours_.size(); ++c) {
            const FlatContour& contour = contours_[c];
            for (std::size_t i = 0; i < contour.points.size(); ++i) {
                const auto [edge, d] = distances_.nearest[c][i];
                const double w = contour.weights[i];
                if (edge < 0 || w * d * d > std::pow(k_sure * scale, 2)) continue;
                const ProjectedOutline::Edge& e = distances_.outlines[c].edges[std::size_t(edge)];
                const double part =
                    distances_.outlines[c].part_of(e, contour.points[i][0], contour.points[i][1]);
                const Vec3 foot = (1 - part) * placed_[std::size_t(e.from)] +
                                  part * placed_[std::size_t(e.to)] - centre;
                const Vec3 n = e.nx * contour.across + e.ny * contour.along;
                const Vec3 turn = glm::cross(foot, n);
                Step row;
                row << -n.x, -n.y, -n.z, -turn.x, -turn.y, -turn.z, -glm::dot(n, foot);
                normal += w * row * row.transpose();
                gradient += w * d * row;
            }
        }
        const double most = std::max(normal.diagonal().maxCoeff(), 1e-300);
        for (int k = 0; k < 7; ++k) {
            if (free_[std::size_t(k)]) {
                normal(k, k) += damping * normal(k, k) + 1e-14 * most;
            } else {
                normal.row(k).setZero();
                normal.col(k).setZero();
                normal(k, k) = 1;
                gradient(k) = 0;
            }
        }
        return -PivotedCholesky(normal).solve_one(gradient);
    }

    std::span<const Vec3> corners_;
    std::span<const FlatContour> contours_;
    Vec3 middle_;
    std::array<bool, 7> free_{};
    std::vector<Vec3> placed_;
    OutlineDistances distances_;
    double scale_ = 0;
};

}  // namespace

std::vector<Vec3> placed_corners(std::span<const Vec3> corners, const Similarity& at) {
    std::vector<Vec3> all;
    all.reserve(corners.size());
    for (const Vec3& c : corners) all.push_back(at.placed(c));
    return all;
}

FrameMotion inverse(const FrameMotion& m) {
    FrameMotion i;
    i.x = {m.x.x, m.y.x, m.z.x};
    i.y = {m.x.y, m.y.y, m.z.y};
    i.z = {m.x.z, m.y.z, m.z.z};
    i.shift = -i.turned(m.shift);
    return i;
}

double registration_cost(std::span<const Vec3> corners, std::span<const FlatContour> contours,
                         const Similarity& at, double scale) {
    return Registration(corners, contours, {}).cost_at(at, scale);
}

Similarity registered(std::span<const Vec3> corners, std::span<const FlatContour> contours,
                      const Similarity& start, const RegistrationOptions& options) {
    return Registration(corners, contours, options).run(start);
}

}  // namespace culet
