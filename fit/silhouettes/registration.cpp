#include "fit/silhouettes/registration.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "stone/perpendicular.h"

namespace culet {

namespace {

using Step = Eigen::Matrix<double, 7, 1>;  // shift, turn, logarithm of the scale
using Normal = Eigen::Matrix<double, 7, 7>;

constexpr int k_most_steps = 60;
// A step that gains less than this part of what is left ends it.
constexpr double k_no_gain = 1e-9;

Vec3 turned_about(const Vec3& v, const Vec3& turn) {
    const double angle = glm::length(turn);
    if (!(angle > 0)) return v;
    const Vec3 axis = turn / angle;
    return std::cos(angle) * v + std::sin(angle) * glm::cross(axis, v) +
           (1 - std::cos(angle)) * glm::dot(axis, v) * axis;
}

std::vector<Vec3> placed_corners(std::span<const Vec3> corners, const Similarity& at) {
    std::vector<Vec3> all;
    all.reserve(corners.size());
    for (const Vec3& c : corners) all.push_back(at.placed(c));
    return all;
}

Vec3 middle(std::span<const Vec3> corners) {
    Vec3 sum(0);
    for (const Vec3& c : corners) sum += c / double(corners.size());
    return sum;
}

// Turned and scaled about where its middle lies, then shifted.
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
        for (int i = 0; i < k_most_steps && damping < 1e8; ++i) {
            const double scale = scale_, before = cost(scale);
            const Step step = solved(scale, damping);
            const Similarity next = moved(at, middle_, step);
            look(next);
            const double after = cost(scale);
            if (after < before) {
                at = next;
                damping = std::max(1e-9, damping / 5);
                if (before - after < k_no_gain * before && scale_ > 0.999 * scale) break;
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
        const FrameMotion same;
        std::vector<FrameMotion> motions(1, same);
        distances_ = outline_distances(placed_, contours_, motions);
        scale_ = robust_scale(distances_, contours_, 0);
    }

    // Of bounded errors: what is farther off than the outliers counts as much as they do.
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
        return -normal.ldlt().solve(gradient);
    }

    std::span<const Vec3> corners_;
    std::span<const FlatContour> contours_;
    Vec3 middle_;
    std::array<bool, 7> free_{};
    std::vector<Vec3> placed_;
    OutlineDistances distances_;
    double scale_ = 0;
};

struct Extent {
    double least = 1e300, most = -1e300;
    void add(double v) {
        least = std::min(least, v);
        most = std::max(most, v);
    }
    double size() const { return most - least; }
    double mid() const { return 0.5 * (least + most); }
};

Extent extent_of(std::span<const Vec3> corners, const Vec3& direction) {
    Extent e;
    for (const Vec3& c : corners) e.add(glm::dot(c, direction));
    return e;
}

Extent extent_of(const FlatContour& contour, const Vec3& direction) {
    const double a = glm::dot(direction, contour.across), b = glm::dot(direction, contour.along);
    Extent e;
    for (const auto& [x, y] : contour.points) e.add(a * x + b * y);
    return e;
}

// Fewer contours and fewer points of each, evenly.
std::vector<FlatContour> thinned(std::span<const FlatContour> contours, std::size_t most,
                                 std::size_t most_points) {
    std::vector<FlatContour> few;
    const std::size_t count = std::min(most, contours.size());
    for (std::size_t k = 0; k < count; ++k) {
        FlatContour c = contours[k * contours.size() / count];
        const std::size_t points = std::min(most_points, c.points.size());
        FlatContour thin = c;
        thin.points.clear();
        thin.weights.clear();
        for (std::size_t i = 0; i < points; ++i) {
            thin.points.push_back(c.points[i * c.points.size() / points]);
            thin.weights.push_back(c.weights[i * c.points.size() / points]);
        }
        thin.set = 0;
        few.push_back(std::move(thin));
    }
    return few;
}

Vec3 sight_of(const FlatContour& contour) {
    return glm::cross(contour.across, contour.along);
}

struct Axes {
    std::vector<Vec3> all;
    bool is_turntable = false;
};

Axes axes_of(std::span<const FlatContour> contours) {
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    for (const FlatContour& c : contours) {
        const Vec3 d = sight_of(c);
        const Eigen::Vector3d v(d.x, d.y, d.z);
        sum += v * v.transpose() / double(contours.size());
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(sum);
    // Directions within a few degrees of one plane.
    if (eigen.eigenvalues()(0) < 0.01 && eigen.eigenvalues()(1) > 0.01) {
        Eigen::Vector3d a = eigen.eigenvectors().col(0);
        Eigen::Index largest = 0;
        a.cwiseAbs().maxCoeff(&largest);
        if (a(largest) < 0) a = -a;
        const Vec3 axis(a(0), a(1), a(2));
        return {{axis, -axis}, true};
    }
    return {{{0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}}, false};
}

// Across the axis, as one sees it along a line of sight.
Vec3 level_of(const Vec3& axis, const FlatContour& contour) {
    const Vec3 level = glm::cross(axis, sight_of(contour));
    return glm::length(level) > 1e-3 ? glm::normalize(level) : perpendicular_to(axis);
}

// The body turned upright along an axis, scaled and shifted to the outlines' extents.
class Search {
public:
    Search(std::span<const Vec3> corners, const Vec3& up, std::span<const FlatContour> contours)
        : corners_(corners), up_(up), contours_(contours) {}

    /// One for each end that the holder may hide.
    std::vector<Similarity> along(const Vec3& axis, bool is_turntable, double azimuth) const {
        Similarity s;
        s.motion = upright(axis, azimuth);
        double ratio = 0;
        for (const FlatContour& c : contours_) ratio += width_ratio(s.motion, axis, c);
        s.scale = ratio / double(contours_.size());
        std::vector<Vec3> body = placed_corners(corners_, s);
        Eigen::Matrix3d normal = Eigen::Matrix3d::Identity() * 1e-9;
        Eigen::Vector3d right = Eigen::Vector3d::Zero();
        Extent above, below;  // of contours less body
        for (const FlatContour& c : contours_) {
            const Vec3 level = level_of(axis, c);
            const auto add = [&](const Vec3& d) {
                const double off = extent_of(c, d).mid() - extent_of(body, d).mid();
                const Eigen::Vector3d v(d.x, d.y, d.z);
                normal += v * v.transpose();
                right += off * v;
            };
            add(level);
            const Vec3 upwards = glm::cross(sight_of(c), level);
            if (!is_turntable) add(upwards);
            const Extent mine = extent_of(c, upwards), its = extent_of(body, upwards);
            const double sign = glm::dot(upwards, axis) < 0 ? -1 : 1;
            above.add(sign > 0 ? mine.most - its.most : its.least - mine.least);
            below.add(sign > 0 ? mine.least - its.least : its.most - mine.most);
        }
        const Eigen::Vector3d shift = normal.ldlt().solve(right);
        s.motion.shift = {shift(0), shift(1), shift(2)};
        if (!is_turntable) return {s};
        Similarity at_top = s, at_bottom = s;
        at_top.motion.shift += (above.mid() - glm::dot(s.motion.shift, axis)) * axis;
        at_bottom.motion.shift += (below.mid() - glm::dot(s.motion.shift, axis)) * axis;
        return {at_top, at_bottom};
    }

private:
    FrameMotion upright(const Vec3& axis, double azimuth) const {
        const Vec3 from_x = perpendicular_to(up_), from_y = glm::cross(up_, from_x);
        const Vec3 x0 = perpendicular_to(axis), y0 = glm::cross(axis, x0);
        const Vec3 to_x = std::cos(azimuth) * x0 + std::sin(azimuth) * y0;
        const Vec3 to_y = glm::cross(axis, to_x);
        FrameMotion m;
        const auto image = [&](const Vec3& v) {
            return glm::dot(v, from_x) * to_x + glm::dot(v, from_y) * to_y +
                   glm::dot(v, up_) * axis;
        };
        m.x = image({1, 0, 0});
        m.y = image({0, 1, 0});
        m.z = image({0, 0, 1});
        return m;
    }

    double width_ratio(const FrameMotion& motion, const Vec3& axis, const FlatContour& c) const {
        const Vec3 level = level_of(axis, c);
        Extent body;
        for (const Vec3& v : corners_) body.add(glm::dot(motion.turned(v), level));
        return extent_of(c, level).size() / std::max(body.size(), 1e-300);
    }

    std::span<const Vec3> corners_;
    Vec3 up_;
    std::span<const FlatContour> contours_;
};

struct Found {
    Similarity at;
    double cost = 0;
};

}  // namespace

FrameMotion inverse(const FrameMotion& m) {
    FrameMotion i;
    i.x = {m.x.x, m.y.x, m.z.x};
    i.y = {m.x.y, m.y.y, m.z.y};
    i.z = {m.x.z, m.y.z, m.z.z};
    i.shift = -i.turned(m.shift);
    return i;
}

Similarity registered(std::span<const Vec3> corners, std::span<const FlatContour> contours,
                      const Similarity& start, const RegistrationOptions& options) {
    return Registration(corners, contours, options).run(start);
}

Similarity found_registration(std::span<const Vec3> corners, const Vec3& up,
                              std::span<const FlatContour> contours) {
    const std::vector<FlatContour> few = thinned(contours, 24, 60);
    const Axes axes = axes_of(contours);
    const Search search(corners, up, few);
    const RegistrationOptions all{.turns = true, .shifts = true, .scales = true};
    Registration trial(corners, few, all);
    double width = 0;
    for (const FlatContour& c : few) {
        width = std::max(width, extent_of(c, c.across).size());
    }
    // What lies farther off than this part of the width is of another place or the holder.
    const double allowed = 0.01 * width;
    std::vector<Found> found;
    constexpr int k_azimuths = 180;
    for (const Vec3& axis : axes.all) {
        for (int k = 0; k < k_azimuths; ++k) {
            const double azimuth = 2 * std::numbers::pi * k / k_azimuths;
            for (const Similarity& s : search.along(axis, axes.is_turntable, azimuth)) {
                found.push_back({s, trial.cost_at(s, allowed)});
            }
        }
    }
    std::stable_sort(found.begin(), found.end(),
                     [](const Found& a, const Found& b) { return a.cost < b.cost; });
    constexpr std::size_t k_tried = 12;
    found.resize(std::min(k_tried, found.size()));
    Found best = found.front();
    for (std::size_t i = 0; i < found.size(); ++i) {
        const Similarity s = registered(corners, few, found[i].at, all);
        const double cost = trial.cost_at(s, 0.25 * allowed);
        if (i == 0 || cost < best.cost) best = {s, cost};
    }
    return registered(corners, thinned(contours, 100, 200), best.at, all);
}

}  // namespace culet
