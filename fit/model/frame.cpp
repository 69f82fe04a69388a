#include "fit/model/frame.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <numeric>

#include "fit/model/azimuth_turn.h"
#include "fit/model/canonical.h"
#include "fit/model/constants.h"
#include "fit/model/orbits.h"
#include "stone/numbers/upper_median.h"
#include "stone/solid/checks.h"
#include "stone/solid/half_edges.h"
#include "stone/text/errors.h"
#include "stone/upright.h"

namespace culet {

Frame::Frame(const Stone& stone, const std::vector<Reading>& readings)
    : stone_(stone), solid_(stone.solid) {
    if (solid_.facets.size() < 4) throw InputError("the mesh has fewer than four facets");
    if (!is_closed(solid_)) {
        const std::vector<Fault> faults = find_faults(solid_, {.planarity = 1e300});
        throw InputError("the mesh is not a closed solid" +
                         (faults.empty() ? std::string() : ": " + faults.front().what) +
                         "; `culet info` lists its faults");
    }
    if (!(volume(solid_) > 0) && (!stone.convex || lies_mirrored(solid_, half_edges(solid_)))) {
        throw InputError(
            "the mesh is inside out: its facets run clockwise seen from outside; turn them round");
    }
    bring_upright(readings);
}

double Frame::scale_of_readings(const std::vector<Reading>& readings, const Vec3& up) const {
    // Outlines have already scaled the mesh.
    if (std::any_of(readings.begin(), readings.end(),
                    [](const Reading& r) { return r.outline_observations != nullptr; })) {
        return 1;
    }
    // Logarithms of read over drawn lengths: first of overall lengths, later of single edges too.
    std::vector<double> logs;
    for (const Reading& r : readings) {
        double mine = 0;
        if (r.kind == ReadingKind::depth) {
            mine = width_along(solid_, up);
        } else if (r.kind == ReadingKind::width) {
            const Vec3 direction =
                r.has_direction ? r.direction
                                : Vec3{std::cos(r.azimuth), std::sin(r.azimuth), 0} * upright_;
            mine = width_along(solid_, direction);
        }
        if (mine > 0 && r.value > 0) logs.push_back(std::log(r.value / mine));
    }
    const auto [least, most] = std::minmax_element(logs.begin(), logs.end());
    // Largest error of a drawing.
    const double drawn = std::log(3.0);
    const bool any_overall = !logs.empty();
    if (any_overall && *most - *least < drawn) {
        return std::exp(std::accumulate(logs.begin(), logs.end(), 0.0) / double(logs.size()));
    }
    // A needle whose table is drawn askew may be as wide as it is long. If overall lengths
    // disagree, or none was read, take the median over single edges too.
    const HalfEdges edges = half_edges(solid_);
    for (const Reading& r : readings) {
        if (r.kind != ReadingKind::edge || r.facets.size() != 2 || !(r.value > 0)) continue;
        for (const Edge& e : edges.edges) {
            if (std::minmax(e.left, e.right) != std::minmax(r.facets[0], r.facets[1])) continue;
            const double mine = glm::length(solid_.vertices[e.from] - solid_.vertices[e.to]);
            if (mine > 0) logs.push_back(std::log(r.value / mine));
            break;
        }
    }
    if (logs.empty()) return 1;
    const double middle = upper_median(logs);
    // If edges differ from the mesh no more than drawings do, keep the mesh's size.
    return !any_overall && std::abs(middle) < drawn ? 1 : std::exp(middle);
}

void Frame::bring_upright(const std::vector<Reading>& readings) {
    Vec3 mean(0);
    for (const Vec3& v : solid_.vertices) mean += v / static_cast<double>(solid_.vertices.size());
    middle_ = mean;

    up_facet_ = stone_.up_facet.empty() ? -1 : find_facet(solid_, stone_.up_facet);
    if (!stone_.up_facet.empty() && up_facet_ < 0) {
        throw InputError(fmt::format("`up` of [stone] names the facet '{}', which the mesh has not",
                                     stone_.up_facet));
    }
    const auto plane_of = [&](const Facet& facet) {
        std::vector<Vec3> loop;
        for (int corner : facet.corners) loop.push_back(solid_.vertices[corner]);
        return plane_through(loop);
    };
    const Vec3 up =
        up_facet_ >= 0 ? plane_of(solid_.facets[up_facet_]).normal : glm::normalize(stone_.up);
    upright_ = turn_upright(up);
    Vec3 out_up = up;
    for (int axis = 0; axis < 3; ++axis) {
        if (std::abs(up[axis]) < std::cos(radians(k_frame.snap_deg))) continue;
        out_up = Vec3(0);
        out_up[axis] = up[axis] > 0 ? 1 : -1;
    }
    outward_ = turn_upright(out_up);

    mesh_scale_ = scale_of_readings(readings, up);
    scale_ = 0.5 * diameter(solid_) * mesh_scale_;
    check(scale_ > 0 && std::isfinite(scale_), "a solid without size");

    const auto inside = [&](const Vec3& p) {
        return upright_ * (p - middle_) * (mesh_scale_ / scale_);
    };
    for (Vec3& v : solid_.vertices) v = inside(v);
    for (Facet& facet : solid_.facets) facet.plane = plane_of(facet);

    // Turn the mesh to the readings' azimuths.
    turn_ = azimuth_turn(
        readings, [&](int facet) { return solid_.facets[facet].plane.normal; },
        stone_.azimuth_from_mesh);
    const glm::dmat3 turn = turn_about_z(turn_);
    for (Vec3& v : solid_.vertices) v = turn * v;
    for (Facet& facet : solid_.facets) {
        facet.plane = plane_of(facet);
        // A rough mesh may have facets that look inwards; the middle is inside any convex stone.
        const Vec3 away = corner_mean(solid_, facet);
        if (stone_.convex && glm::dot(facet.plane.normal, away) < 0) {
            facet.plane.normal = glm::normalize(away);
            facet.plane.offset = glm::length(away);
        }
    }
}

bool Frame::is_girdle(int facet) const {
    return std::abs(solid_.facets[facet].plane.normal.z) <
           std::sin(radians(k_frame.girdle_tilt_deg));
}

double Frame::half_width() const {
    double widest = 0;
    for (int k = 0; k < k_frame.width_directions; ++k) {
        const double a = std::numbers::pi * k / k_frame.width_directions;
        widest = std::max(widest, width_along(solid_, Vec3{std::cos(a), std::sin(a), 0}));
    }
    return 0.5 * widest;
}

double Frame::unit_of(const Reading& reading) const {
    switch (reading.kind) {
        case ReadingKind::inclination:
        case ReadingKind::azimuth:
        case ReadingKind::dihedral:
        case ReadingKind::parallel:
        case ReadingKind::rotation:
        case ReadingKind::mirror:
            return 1;
        case ReadingKind::volume:
            return std::pow(scale_ * mm_per(stone_.unit), 3);
        case ReadingKind::weight:
            return carat(std::pow(scale_ * mm_per(stone_.unit), 3),
                         stone_.material.density_g_cm3.value_or(1));
        case ReadingKind::line:
            return reading.pixels * scale_ / mesh_scale_;
        default:
            return scale_;
    }
}

Quantity Frame::turn_of(const Shape& shape) const {
    Quantity turn;
    if (stone_.azimuth_from_mesh) return turn;
    // Kabsch (1976) about one axis.
    const std::size_t count = solid_.vertices.size();
    Vec3 mean(0), mesh_mean(0);
    for (std::size_t v = 0; v < count; ++v) {
        mean += shape.points[v] / double(count);
        mesh_mean += solid_.vertices[v] / double(count);
    }
    double east = 0, north = 0;
    for (std::size_t v = 0; v < count; ++v) {
        const Vec3 p = shape.points[v] - mean, q = solid_.vertices[v] - mesh_mean;
        east += p.x * q.x + p.y * q.y;
        north += p.x * q.y - p.y * q.x;
    }
    turn.value = std::atan2(north, east) - turn_;
    const double size = east * east + north * north;
    for (std::size_t v = 0; v < count && size > 0; ++v) {
        const Vec3 q = solid_.vertices[v] - mesh_mean;
        turn.add(Quantity::By::point, int(v),
                 Vec3{east * q.y - north * q.x, -east * q.x - north * q.y, 0} / size);
    }
    return turn;
}

Frame::Pose Frame::pose_of(const Shape& shape) const {
    Pose pose;
    const std::size_t count = solid_.vertices.size();
    pose.turn = turn_of(shape).value;
    Vec3 mean(0);
    for (std::size_t v = 0; v < count; ++v) mean += shape.points[v] / double(count);
    pose.shift = middle_ - (turn_about_z(pose.turn) * mean) * outward_ * scale_;
    return pose;
}

Vec3 Frame::outside_point(const Vec3& p, const Pose& pose) const {
    return (turn_about_z(pose.turn) * p) * outward_ * scale_ + pose.shift;
}

Plane Frame::outside_plane(const Plane& plane, const Pose& pose) const {
    const Vec3 n = glm::normalize((turn_about_z(pose.turn) * plane.normal) * outward_);
    return {n, plane.offset * scale_ + glm::dot(n, pose.shift)};
}

glm::dmat3 Frame::turn_inside(From from) const {
    return turn_about_z(turn_) * (from == From::mesh ? upright_ : outward_);
}

Vec3 Frame::inside_direction(const Vec3& direction) const {
    return turn_about_z(turn_) * (upright_ * direction);
}

}  // namespace culet
