// Finds the place of a body among outlines of which only the directions are known.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "fit/silhouettes/registration.h"
#include "stone/numbers/dense_algebra.h"
#include "stone/solid/perpendicular.h"

namespace culet {

namespace {

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

// Evenly chosen contours and points.
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
    const SymmetricEigen3 eigen = symmetric_eigen3(sum);
    // The directions lie within a few degrees of one plane.
    if (eigen.values(0) < 0.01 && eigen.values(1) > 0.01) {
        Eigen::Vector3d a = eigen.vectors.col(0);
        Eigen::Index largest = 0;
        a.cwiseAbs().maxCoeff(&largest);
        if (a(largest) < 0) a = -a;
        const Vec3 axis(a(0), a(1), a(2));
        return {{axis, -axis}, true};
    }
    return {{{0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}}, false};
}

// Perpendicular to the axis and the line of sight.
Vec3 level_of(const Vec3& axis, const FlatContour& contour) {
    const Vec3 level = glm::cross(axis, sight_of(contour));
    return glm::length(level) > 1e-3 ? glm::normalize(level) : perpendicular_to(axis);
}

class Search {
public:
    Search(std::span<const Vec3> corners, const Vec3& up, std::span<const FlatContour> contours)
        : corners_(corners), up_(up), contours_(contours) {}

    /// One place for each end that the holder may hide.
    std::vector<Similarity> along(const Vec3& axis, bool is_turntable, double azimuth) const {
        Similarity s;
        s.motion = upright(axis, azimuth);
        double ratio = 0;
        for (const FlatContour& c : contours_) ratio += width_ratio(s.motion, axis, c);
        s.scale = ratio / double(contours_.size());
        std::vector<Vec3> body = placed_corners(corners_, s);
        Eigen::Matrix3d normal = Eigen::Matrix3d::Identity() * 1e-9;
        Eigen::Vector3d right = Eigen::Vector3d::Zero();
        Extent above, below;  // contours' ends - the body's
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
        const Eigen::Vector3d shift = PivotedCholesky(normal).solve_one(right);
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

struct Trial {
    Similarity at;
    double cost = 0;
};

bool is_better(const Trial& a, const Trial& b) {
    return a.cost < b.cost;
}

// True if each corner of one place is near one of the other: the same place, or equal by the body's
// symmetry.
bool are_alike(const std::vector<Vec3>& one, const std::vector<Vec3>& other, double within) {
    return std::all_of(one.begin(), one.end(), [&](const Vec3& v) {
        return std::any_of(other.begin(), other.end(),
                           [&](const Vec3& w) { return glm::length(v - w) < within; });
    });
}

// The best trials that are not alike.
std::vector<Trial> different(std::vector<Trial> trials, std::span<const Vec3> corners,
                             double within, std::size_t most) {
    std::stable_sort(trials.begin(), trials.end(), is_better);
    std::vector<Trial> kept;
    std::vector<std::vector<Vec3>> places;
    for (const Trial& trial : trials) {
        std::vector<Vec3> place = placed_corners(corners, trial.at);
        if (std::any_of(places.begin(), places.end(),
                        [&](const auto& other) { return are_alike(place, other, within); })) {
            continue;
        }
        kept.push_back(trial);
        places.push_back(std::move(place));
        if (kept.size() == most) break;
    }
    return kept;
}

}  // namespace

Similarity found_registration(std::span<const Vec3> corners, const Vec3& up,
                              std::span<const FlatContour> contours) {
    const std::vector<FlatContour> few = thinned(contours, 24, 60);
    const Axes axes = axes_of(contours);
    const Search search(corners, up, few);
    const RegistrationOptions all{.turns = true, .shifts = true, .scales = true};
    double width = 0;
    for (const FlatContour& c : few) {
        width = std::max(width, extent_of(c, c.across).size());
    }
    // Points further off than this part of the width belong to another place or the holder.
    const double allowed = 0.01 * width;
    std::vector<Trial> found;
    constexpr int k_azimuths = 180;
    for (const Vec3& axis : axes.all) {
        for (int k = 0; k < k_azimuths; ++k) {
            const double azimuth = 2 * std::numbers::pi * k / k_azimuths;
            for (const Similarity& s : search.along(axis, axes.is_turntable, azimuth)) {
                found.push_back({s, registration_cost(corners, few, s, allowed)});
            }
        }
    }
    constexpr std::size_t k_tried = 12;
    constexpr double k_alike = 0.03;  // of the width: about four degrees of turn
    found = different(std::move(found), corners, k_alike * width, k_tried);
    const std::vector<FlatContour> more = thinned(contours, 60, 120);
    for (Trial& trial : found) {
        trial.at = registered(corners, few, trial.at, all);
        trial.cost = registration_cost(corners, more, trial.at, 0.25 * allowed);
    }
    const Trial& best = *std::min_element(found.begin(), found.end(), is_better);
    return registered(corners, more, best.at, all);
}

}  // namespace culet
