#include "render/geometry/polyhedron_body.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <utility>

#include "stone/text/errors.h"

namespace culet {

namespace {

// Relative to the stone's size: above the rounding of corners, below anything visible.
constexpr double k_flat = 1e-12;

// A thread's buffers, so that rays allocate nothing. `step` is all 0 between rays.
struct Scratch {
    std::vector<double> x, y;
    std::vector<unsigned char> side;
    std::vector<int> candidates, step, touched;
    std::vector<LineCrossing> crossings;

    void fit(std::size_t vertices, std::size_t edges, std::size_t facets) {
        if (x.size() < vertices) {
            x.resize(vertices);
            y.resize(vertices);
            side.resize(vertices);
        }
        if (candidates.size() < edges) candidates.resize(edges);
        if (step.size() < facets) step.resize(facets, 0);
    }
};

Scratch& scratch() {
    thread_local Scratch mine;
    return mine;
}

// Exact sign of a.x b.y - a.y b.x. Rounding preserves order, so rounding errors are compared only
// for equal products.
int turn(double ax, double ay, double bx, double by) {
    const double left = ax * by, right = ay * bx;
    if (left != right) return left > right ? 1 : -1;
    const double left_error = std::fma(ax, by, -left), right_error = std::fma(ay, bx, -right);
    return (left_error > right_error) - (left_error < right_error);
}

bool comes_before(const LineCrossing& a, const LineCrossing& b) {
    if (a.distance != b.distance) return a.distance < b.distance;
    if ((a.step > 0) != (b.step > 0)) return a.step > 0;
    return a.facet < b.facet;
}

// Flags of a projected vertex. Shifted right by `k_right_shift`, k_right becomes k_above.
constexpr unsigned k_above = 1, k_right = 2, k_right_shift = 1;

// Facets along an edge: from its lower to its higher vertex, and back.
using EdgeUses = std::map<std::pair<int, int>, std::pair<std::vector<int>, std::vector<int>>>;

EdgeUses edge_uses(const Solid& solid) {
    const int vertex_count = static_cast<int>(solid.vertices.size());
    EdgeUses uses;
    for (std::size_t f = 0; f < solid.facets.size(); ++f) {
        const Facet& facet = solid.facets[f];
        const int index = static_cast<int>(f);
        if (facet.corners.empty())
            throw InputError(fmt::format("facet {} has no corners", facet.name));
        for (std::size_t i = 0; i < facet.corners.size(); ++i) {
            const int a = facet.corners[i], b = facet.corners[(i + 1) % facet.corners.size()];
            if (std::min(a, b) < 0 || std::max(a, b) >= vertex_count) {
                throw InputError(
                    fmt::format("facet {} has a corner that does not exist", facet.name));
            }
            if (a < b) uses[{a, b}].first.push_back(index);
            if (a > b) uses[{b, a}].second.push_back(index);
        }
    }
    return uses;
}

// For each facet, whether the whole stone is behind its plane.
std::vector<bool> outermost_of(const Solid& solid) {
    Vec3 low = solid.vertices[0], high = low;
    for (const Vec3& vertex : solid.vertices) {
        low = glm::min(low, vertex);
        high = glm::max(high, vertex);
    }
    const double margin = k_flat * glm::length(high - low);
    std::vector<bool> outermost;
    for (const Facet& facet : solid.facets) {
        outermost.push_back(std::all_of(
            solid.vertices.begin(), solid.vertices.end(),
            [&](const Vec3& vertex) { return height_above(facet.plane, vertex) <= margin; }));
    }
    return outermost;
}

// For each facet, the others that share a vertex with it, in order.
std::vector<std::vector<int>> vertex_sharers_of(const Solid& solid) {
    std::vector<std::vector<int>> facets_at(solid.vertices.size()), sharers;
    for (std::size_t f = 0; f < solid.facets.size(); ++f) {
        for (const int corner : solid.facets[f].corners)
            facets_at[static_cast<std::size_t>(corner)].push_back(static_cast<int>(f));
    }
    for (std::size_t f = 0; f < solid.facets.size(); ++f) {
        std::vector<int>& of = sharers.emplace_back();
        for (const int corner : solid.facets[f].corners) {
            const auto& here = facets_at[static_cast<std::size_t>(corner)];
            of.insert(of.end(), here.begin(), here.end());
        }
        std::sort(of.begin(), of.end());
        of.erase(std::unique(of.begin(), of.end()), of.end());
        std::erase(of, static_cast<int>(f));
    }
    return sharers;
}

}  // namespace

PolyhedronBody::PolyhedronBody(const Solid& solid) {
    if (solid.facets.size() < 4) throw InputError("a solid needs at least 4 facets");
    // If more than two facets share an edge, their pairing makes no difference to a ray.
    for (const auto& [ends, facets] : edge_uses(solid)) {
        const auto& [along, against] = facets;
        if (along.size() != against.size()) {
            const int facet = along.empty() ? against.front() : along.front();
            throw InputError(
                fmt::format("the stone is not closed: facet {} has an edge without a neighbour",
                            solid.facets[static_cast<std::size_t>(facet)].name));
        }
        for (std::size_t i = 0; i < along.size(); ++i) {
            edges_.push_back({ends.first, ends.second, along[i], against[i]});
        }
    }
    for (const Vec3& vertex : solid.vertices) {
        for (int axis = 0; axis < 3; ++axis) coordinates_[axis].push_back(vertex[axis]);
    }
    for (const Facet& facet : solid.facets) {
        all_.push_back(static_cast<int>(all_.size()));
        normals_.push_back(facet.plane.normal);
        offsets_.push_back(facet.plane.offset);
        corners_.push_back(facet.corners);
    }
    outermost_ = outermost_of(solid);
    vertex_sharers_ = vertex_sharers_of(solid);
}

// Distance to the facet's plane, clamped to the facet's extent along the line: a facet seen edge-on
// has no better answer.
double PolyhedronBody::distance_to(std::size_t facet, const Vec3& origin,
                                   const Vec3& direction) const {
    const double inverse_length = 1 / glm::dot(direction, direction);
    double first = std::numeric_limits<double>::infinity(), last = -first;
    for (const int corner : corners_[facet]) {
        const std::size_t v = static_cast<std::size_t>(corner);
        const double along = (coordinates_[0][v] - origin.x) * direction.x +
                             (coordinates_[1][v] - origin.y) * direction.y +
                             (coordinates_[2][v] - origin.z) * direction.z;
        first = std::min(first, along);
        last = std::max(last, along);
    }
    const double distance = (offsets_[facet] - glm::dot(normals_[facet], origin)) /
                            glm::dot(normals_[facet], direction);
    // Also catches 0/0.
    if (!(distance >= first * inverse_length)) return first * inverse_length;
    return std::min(distance, last * inverse_length);
}

// All crossings in order; that of `from` gets distance 0 exactly.
std::span<const LineCrossing> PolyhedronBody::trace(const Vec3& origin, const Vec3& direction,
                                                    int from) const {
    Scratch& work = scratch();
    const std::size_t vertex_count = coordinates_[0].size();
    work.fit(vertex_count, edges_.size(), normals_.size());

    // Shear the line onto its dominant axis; the other two axes lie across it.
    const Vec3 size = glm::abs(direction);
    const int axis = size.x >= size.y ? (size.x >= size.z ? 0 : 2) : (size.y >= size.z ? 1 : 2);
    const int right = (axis + 1) % 3, up = (axis + 2) % 3;
    const double shear_right = direction[right] / direction[axis];
    const double shear_up = direction[up] / direction[axis];
    const double *along = coordinates_[axis].data(), *rightward = coordinates_[right].data(),
                 *upward = coordinates_[up].data();
    const double at_along = origin[axis], at_right = origin[right], at_up = origin[up];
    double *x = work.x.data(), *y = work.y.data();
    for (std::size_t v = 0; v < vertex_count; ++v) {
        const double depth = along[v] - at_along;
        x[v] = (rightward[v] - at_right) - shear_right * depth;
        y[v] = (upward[v] - at_up) - shear_up * depth;
    }
    unsigned char* side = work.side.data();
    for (std::size_t v = 0; v < vertex_count; ++v) {
        side[v] =
            static_cast<unsigned char>((y[v] >= 0 ? k_above : 0u) | (x[v] > 0 ? k_right : 0u));
    }

    // Collect edges that may cross the half-axis to the right.
    std::size_t candidate_count = 0;
    int* candidates = work.candidates.data();
    const Edge* edges = edges_.data();
    const std::size_t edge_count = edges_.size();
    for (std::size_t e = 0; e < edge_count; ++e) {
        const unsigned low = side[edges[e].low], high = side[edges[e].high];
        candidates[candidate_count] = static_cast<int>(e);
        candidate_count += (low ^ high) & ((low | high) >> k_right_shift) & k_above;
    }

    // An edge adds opposite amounts to the windings of its two facets. Along the line, a
    // counter-clockwise outline is left.
    const int out = direction[axis] > 0 ? -1 : 1;
    work.touched.clear();
    for (std::size_t i = 0; i < candidate_count; ++i) {
        const Edge& edge = edges_[static_cast<std::size_t>(candidates[i])];
        const std::size_t a = static_cast<std::size_t>(edge.low);
        const std::size_t b = static_cast<std::size_t>(edge.high);
        const bool rising = (side[b] & k_above) != 0;
        const int sense = rising ? 1 : -1;
        if (!(side[a] & side[b] & k_right) && turn(x[a], y[a], x[b], y[b]) != sense) continue;
        work.step[static_cast<std::size_t>(edge.along)] += out * sense;
        work.step[static_cast<std::size_t>(edge.against)] -= out * sense;
        work.touched.push_back(edge.along);
        work.touched.push_back(edge.against);
    }

    work.crossings.clear();
    for (const int facet : work.touched) {
        const std::size_t f = static_cast<std::size_t>(facet);
        const int step = std::exchange(work.step[f], 0);
        if (step == 0) continue;
        const double distance = facet == from ? 0 : distance_to(f, origin, direction);
        const LineCrossing crossing{facet, step, distance};
        // There are few: insert in order.
        auto place = work.crossings.end();
        while (place != work.crossings.begin() && comes_before(crossing, *(place - 1))) --place;
        work.crossings.insert(place, crossing);
    }
    return work.crossings;
}

std::vector<LineCrossing> PolyhedronBody::crossings(const Vec3& origin,
                                                    const Vec3& direction) const {
    const auto found = trace(origin, direction, -1);
    return {found.begin(), found.end()};
}

std::optional<BodyHit> PolyhedronBody::entry(const Vec3& origin, const Vec3& direction) const {
    const auto found = trace(origin, direction, -1);
    int depth = 0;
    const LineCrossing* entered = nullptr;
    for (const LineCrossing& crossing : found) {
        const int before = std::exchange(depth, depth + crossing.step);
        if (before <= 0 && depth > 0) entered = &crossing;
        if (before > 0 && depth <= 0 && crossing.distance > entered->distance) {
            // The ray is inside from `entered` to `crossing`.
            if (entered->distance >= 0) return BodyHit{entered->facet, entered->distance};
            if (crossing.distance > 0) return std::nullopt;
        }
    }
    return std::nullopt;
}

bool PolyhedronBody::contains(const Vec3& point) const {
    // Along all three axes, because at least one shows that a point lies on a facet.
    for (int axis = 0; axis < 3; ++axis) {
        Vec3 direction{0, 0, 0};
        direction[axis] = 1;
        int depth = 0;
        for (const LineCrossing& crossing : trace(point, direction, -1)) {
            if (crossing.distance == 0) return false;
            if (crossing.distance < 0) depth += crossing.step;
        }
        if (depth <= 0) return false;
    }
    return true;
}

Vec3 PolyhedronBody::on_facet(int facet, const Vec3& point) const {
    const std::size_t f = static_cast<std::size_t>(facet);
    return point - (glm::dot(normals_[f], point) - offsets_[f]) * normals_[f];
}

}  // namespace culet
