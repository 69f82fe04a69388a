// Finds the faces of each facet: joined by edges, with corners in one plane within the coordinates'
// accuracy.

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>
#include <queue>
#include <tuple>

#include "stone/mesh/face_soup.h"

namespace culet {

namespace {

/// Its area vector is the sum of the faces', so its direction is as good as one from the whole
/// outline.
struct GrowingFacet {
    Vec3 area_vector{0, 0, 0};
    Vec3 corner_sum{0, 0, 0};
    double corner_count = 0;

    Plane plane() const {
        const Vec3 normal = glm::normalize(area_vector);
        return {normal, glm::dot(normal, corner_sum / corner_count)};
    }
};

struct FaceShape {
    GrowingFacet share;   // relative to the mesh's first vertex
    bool sliver = false;  // too thin for its corners to define a direction
    bool normal_agrees = false;
};

class FacetGrower {
public:
    FacetGrower(const FaceSoup& soup, double tolerance, double size)
        : soup_(soup), tolerance_(tolerance), loose_tolerance_(1e-3 * size) {
        trust_normals_ = soup.normal_precision.rounding() < 1e-6;
        for (const SoupFace& face : soup.faces) shapes_.push_back(shape_of(face));
        find_neighbours();
    }

    std::vector<int> grow_all() {
        facet_.assign(soup_.faces.size(), -1);
        // The largest faces have the most certain directions.
        std::vector<int> seeds(soup_.faces.size());
        std::iota(seeds.begin(), seeds.end(), 0);
        std::vector<double> area;
        for (const FaceShape& shape : shapes_) area.push_back(glm::length(shape.share.area_vector));
        std::sort(seeds.begin(), seeds.end(), [&](int a, int b) {
            return std::tuple(shapes_[a].sliver, -area[a], a) <
                   std::tuple(shapes_[b].sliver, -area[b], b);
        });
        for (const int seed : seeds) {
            if (facet_[seed] < 0) grow(seed);
        }
        std::vector<int> number(soup_.faces.size(), -1);
        int next = 0;
        for (int& facet : facet_) {
            if (number[facet] < 0) number[facet] = next++;
            facet = number[facet];
        }
        return facet_;
    }

private:
    Vec3 relative(int vertex) const { return soup_.vertices[vertex] - soup_.vertices[0]; }

    FaceShape shape_of(const SoupFace& face) const {
        FaceShape shape;
        const std::size_t n = face.corners.size();
        double reach = 0;
        const Vec3 origin = n > 0 ? relative(face.corners[0]) : Vec3(0);
        for (std::size_t i = 0; i < n; ++i) {
            const Vec3 a = relative(face.corners[i]), b = relative(face.corners[(i + 1) % n]);
            shape.share.area_vector += 0.5 * glm::cross(a - origin, b - origin);
            shape.share.corner_sum += a;
            reach = std::max(reach, glm::length(a - origin));
            reach = std::max(reach, glm::length(b - a));
        }
        shape.share.corner_count = static_cast<double>(n);
        const double area = glm::length(shape.share.area_vector);
        // Corners that are off by the tolerance turn a face by the tolerance over its width.
        shape.sliver = !(2 * area > 8 * tolerance_ * reach) || !(area > 0);
        const double given = glm::length(face.given_normal);
        shape.normal_agrees =
            given > 0 && (shape.sliver || glm::dot(face.given_normal, shape.share.area_vector) >
                                              0.98 * given * area);
        return shape;
    }

    void find_neighbours() {
        struct Side {
            int low, high, face;
            bool forward;
        };
        std::vector<Side> sides;
        for (std::size_t f = 0; f < soup_.faces.size(); ++f) {
            const std::vector<int>& corners = soup_.faces[f].corners;
            for (std::size_t i = 0; i < corners.size(); ++i) {
                const int a = corners[i], b = corners[(i + 1) % corners.size()];
                sides.push_back({std::min(a, b), std::max(a, b), static_cast<int>(f), a < b});
            }
        }
        std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
            return std::tie(a.low, a.high, a.face) < std::tie(b.low, b.high, b.face);
        });
        neighbours_.resize(soup_.faces.size());
        for (std::size_t i = 0, end = 0; i < sides.size(); i = end) {
            for (end = i; end < sides.size() && sides[end].low == sides[i].low &&
                          sides[end].high == sides[i].high;) {
                ++end;
            }
            if (end - i != 2 || sides[i].forward == sides[i + 1].forward) continue;
            neighbours_[sides[i].face].push_back(sides[i + 1].face);
            neighbours_[sides[i + 1].face].push_back(sides[i].face);
        }
    }

    bool within(const SoupFace& face, const Plane& plane, double limit) const {
        return std::all_of(face.corners.begin(), face.corners.end(), [&](int corner) {
            return std::abs(height_above(plane, relative(corner))) <= limit;
        });
    }

    bool fits(const GrowingFacet& facet, const GrowingFacet& joined, int seed, int face) const {
        const SoupFace &first = soup_.faces[seed], &other = soup_.faces[face];
        if (first.name != other.name) return false;
        // A writer that repeats a facet's own normal tells which triangles belong together, even
        // where near-miss meets bend the facet.
        if (trust_normals_ && shapes_[seed].normal_agrees && shapes_[face].normal_agrees &&
            first.given_normal == other.given_normal) {
            const Vec3 normal = glm::normalize(first.given_normal);
            const Plane given{normal, glm::dot(normal, facet.corner_sum / facet.corner_count)};
            if (within(other, given, loose_tolerance_)) return true;
        }
        if (!shapes_[face].sliver &&
            !(glm::dot(shapes_[face].share.area_vector, facet.area_vector) > 0)) {
            return false;
        }
        const Plane plane = joined.plane();
        return within(other, plane, tolerance_) && within(first, plane, tolerance_);
    }

    void grow(int seed) {
        facet_[seed] = seed;
        // Nothing can be coplanar with a sliver, which has no plane of its own.
        if (shapes_[seed].sliver) return;
        GrowingFacet facet = shapes_[seed].share;
        std::vector<int> members{seed};
        bool by_plane = true;
        for (std::size_t next = 0; next < members.size(); ++next) {
            for (const int face : neighbours_[members[next]]) {
                if (facet_[face] >= 0) continue;
                GrowingFacet joined = facet;
                joined.area_vector += shapes_[face].share.area_vector;
                joined.corner_sum += shapes_[face].share.corner_sum;
                joined.corner_count += shapes_[face].share.corner_count;
                if (!fits(facet, joined, seed, face)) continue;
                by_plane &= soup_.faces[face].given_normal == Vec3(0) ||
                            soup_.faces[face].given_normal != soup_.faces[seed].given_normal;
                facet = joined;
                facet_[face] = seed;
                members.push_back(face);
            }
        }
        // Each face fitted when it joined; all must also fit the final plane.
        if (!by_plane || members.size() == 1) return;
        const Plane plane = facet.plane();
        const bool planar = std::all_of(members.begin(), members.end(), [&](int face) {
            return within(soup_.faces[face], plane, 2 * tolerance_);
        });
        if (planar) return;
        for (const int face : members) facet_[face] = -1;
        facet_[seed] = seed;
    }

    const FaceSoup& soup_;
    double tolerance_, loose_tolerance_;
    bool trust_normals_ = false;
    std::vector<FaceShape> shapes_;
    std::vector<std::vector<int>> neighbours_;
    std::vector<int> facet_;  // by the index of its seed
};

}  // namespace

double size_of(const FaceSoup& soup) {
    Solid points;
    points.vertices = soup.vertices;
    return diameter(points);
}

double merging_tolerance(const FaceSoup& soup, double size) {
    // Coarse digits must not merge what a cutter would tell apart.
    const double rounding = std::min(soup.precision.rounding(), 1e-4 * size);
    return std::max(4 * rounding, 1e-11 * size);
}

std::vector<int> facet_of_face(const FaceSoup& soup, double tolerance) {
    if (soup.faces.empty()) return {};
    return FacetGrower(soup, tolerance, size_of(soup)).grow_all();
}

}  // namespace culet
