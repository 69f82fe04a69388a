// The convex solid of half-spaces by exact incremental clipping.
//
// A box far beyond every meet is clipped by one plane after another. A corner is always the meet of
// three of the given planes, never a point computed from other points. So the exact numbers stay as
// short as the input allows, and no tree of lazy evaluations grows with the number of planes. Every
// side is decided exactly: by interval arithmetic first, by rationals when the interval contains
// zero (CGAL's Exact_predicates_exact_constructions_kernel).

#ifdef __wasm__
#include <CGAL/MP_Float.h>
#include <CGAL/Simple_homogeneous.h>
#else
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#endif
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <boost/variant/get.hpp>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <unordered_map>
#include <utility>
#include <vector>

#include "stone/progress/check_stop.h"
#include "stone/solid/solid.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

#ifdef __wasm__
// Exact from the start, as in exact_sides.cpp, and without division: meets are homogeneous.
using Exact = CGAL::Simple_homogeneous<CGAL::MP_Float>;
#else
using Exact = CGAL::Exact_predicates_exact_constructions_kernel;
#endif
using CornerPair = std::pair<int, int>;

// The box is this many powers of two larger than the largest offset. Three planes of doubles cannot
// meet further out unless they are parallel to within 1e-30, and the numbers still fit a double, so
// that interval arithmetic decides nearly all sides.
constexpr int k_box_exponent = 300;

struct Corner {
    Exact::Point_3 point;
    CGAL::Sign side = CGAL::ZERO;  // of the plane that is being inserted
    bool sided = false;
};

struct Face {
    int plane = -1;
    std::vector<int> corners;  // counter-clockwise from outside
};

CornerPair ordered(int a, int b) {
    return {std::min(a, b), std::max(a, b)};
}

class Clipper {
public:
    /// The last six planes are the box, in the order +x -x +y -y +z -z.
    explicit Clipper(std::vector<Exact::Plane_3> planes) : planes_(std::move(planes)) {
        const int first = static_cast<int>(planes_.size()) - 6;
        // Corner k lies at +x when bit 0 is set, at +y for bit 1, at +z for bit 2.
        for (int k = 0; k < 8; ++k) {
            add_corner(first + (k & 1 ? 0 : 1), first + (k & 2 ? 2 : 3), first + (k & 4 ? 4 : 5));
        }
        const std::vector<std::vector<int>> outlines{{1, 3, 7, 5}, {0, 4, 6, 2}, {2, 6, 7, 3},
                                                     {0, 1, 5, 4}, {4, 5, 7, 6}, {0, 2, 3, 1}};
        for (int i = 0; i < 6; ++i) faces_.push_back({first + i, outlines[i]});
    }

    /// Cuts off what lies above a plane. False when nothing is left inside.
    bool clip(int plane) {
        bool any_inside = false, any_outside = false;
        for (const Face& face : faces_) {
            for (const int c : face.corners) corners_[c].sided = false;
        }
        for (const Face& face : faces_) {
            for (const int c : face.corners) {
                Corner& corner = corners_[c];
                if (corner.sided) continue;
                corner.sided = true;
                corner.side = planes_[plane].oriented_side(corner.point);
                any_inside |= corner.side == CGAL::NEGATIVE;
                any_outside |= corner.side == CGAL::POSITIVE;
            }
        }
        if (!any_inside) return false;
        if (!any_outside) return true;  // touches a facet, an edge, a corner, or nothing

        // Its two facets' planes and this one meet in the new corner.
        std::map<CornerPair, std::pair<int, int>> planes_of_cut;
        for (const Face& face : faces_) {
            for_each_edge(face, [&](int from, int to) {
                if (corners_[from].side * corners_[to].side != CGAL::NEGATIVE) return;
                const auto [at, is_new] =
                    planes_of_cut.try_emplace(ordered(from, to), face.plane, -1);
                if (!is_new) at->second.second = face.plane;
            });
        }
        std::map<CornerPair, int> corner_of_cut;
        for (const auto& [edge, pair] : planes_of_cut) {
            check(pair.second >= 0, "an edge under the knife has one facet only");
            corner_of_cut[edge] = add_corner(pair.first, pair.second, plane);
        }

        // Maps each corner to the next.
        std::unordered_map<int, int> next;
        std::vector<Face> kept;
        kept.reserve(faces_.size() + 1);
        for (Face& face : faces_) {
            Face rest = cut(face, corner_of_cut, next);
            if (rest.corners.size() >= 3) kept.push_back(std::move(rest));
        }
        faces_ = std::move(kept);
        check(!next.empty(), "a plane that cuts the solid leaves no outline");
        Face added{plane, {next.begin()->first}};
        // Start at the lowest corner so that the result does not depend on hash order.
        for (const auto& step : next) {
            added.corners[0] = std::min(added.corners[0], step.first);
        }
        while (added.corners.size() < next.size()) {
            added.corners.push_back(next.at(added.corners.back()));
        }
        faces_.push_back(std::move(added));
        return true;
    }

    const std::vector<Face>& faces() const { return faces_; }
    const Exact::Point_3& point(int corner) const { return corners_[corner].point; }

private:
    int add_corner(int p, int q, int r) {
        const auto meet = CGAL::intersection(planes_[p], planes_[q], planes_[r]);
        const Exact::Point_3* point = meet ? boost::get<Exact::Point_3>(&*meet) : nullptr;
        check(point != nullptr, "three planes of a corner do not meet in a point");
        corners_.push_back({*point});
        return static_cast<int>(corners_.size()) - 1;
    }

    template <class Visit>
    static void for_each_edge(const Face& face, Visit visit) {
        for (std::size_t i = 0; i < face.corners.size(); ++i) {
            visit(face.corners[i], face.corners[(i + 1) % face.corners.size()]);
        }
    }

    // The new facet runs against the cut, from where the outline comes back inside to where it
    // left. A facet that vanishes but has an edge in the plane passes that edge on.
    Face cut(const Face& face, const std::map<CornerPair, int>& corner_of_cut,
             std::unordered_map<int, int>& next) const {
        bool any_inside = false, any_outside = false;
        for (const int c : face.corners) {
            any_inside |= corners_[c].side == CGAL::NEGATIVE;
            any_outside |= corners_[c].side == CGAL::POSITIVE;
        }
        if (!any_outside) return face;
        Face rest{face.plane, {}};
        if (!any_inside) {
            for_each_edge(face, [&](int from, int to) {
                if (corners_[from].side == CGAL::ZERO && corners_[to].side == CGAL::ZERO) {
                    next[from] = to;
                }
            });
            return rest;
        }
        int leaves = -1, returns = -1;
        for_each_edge(face, [&](int from, int to) {
            const CGAL::Sign a = corners_[from].side, b = corners_[to].side;
            if (a != CGAL::POSITIVE) rest.corners.push_back(from);
            if (a == CGAL::ZERO && b == CGAL::POSITIVE) leaves = from;
            if (a == CGAL::POSITIVE && b == CGAL::ZERO) returns = to;
            if (a * b != CGAL::NEGATIVE) return;
            const int corner = corner_of_cut.at(ordered(from, to));
            rest.corners.push_back(corner);
            (b == CGAL::POSITIVE ? leaves : returns) = corner;
        });
        check(leaves >= 0 && returns >= 0, "a cut facet is not convex");
        next[returns] = leaves;
        return rest;
    }

    std::vector<Exact::Plane_3> planes_;
    std::vector<Corner> corners_;
    std::vector<Face> faces_;
};

bool all_finite(const Vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// Scales the largest offset to 1/2..1, exactly, so that tiny and huge stones use the same
/// exponents as others.
int scale_exponent(std::span<const NamedPlane> planes) {
    double largest = 0;
    for (const NamedPlane& p : planes) {
        largest = std::max(largest, std::abs(p.plane.offset) / glm::length(p.plane.normal));
    }
    int exponent = 0;
    std::frexp(largest, &exponent);
    return -exponent;
}

Exact::Plane_3 exact_plane(const Plane& plane, int exponent) {
    return {plane.normal.x, plane.normal.y, plane.normal.z, -std::ldexp(plane.offset, exponent)};
}

Plane unit_plane(const Plane& plane) {
    const double length = glm::length(plane.normal);
    // A unit normal rounded to doubles is off by a few units in the last place: keep it.
    if (std::abs(length - 1) < 4e-16) return plane;
    return {plane.normal / length, plane.offset / length};
}

// CGAL's to_double of a lazy number may have a relative error of 1e-5: round the exact number.
template <class Number>
double nearest_double(const Number& value) {
    if constexpr (requires { value.exact(); }) {
        return CGAL::to_double(value.exact());
    } else {
        return CGAL::to_double(value);
    }
}

Vec3 rounded(const Exact::Point_3& point, int exponent) {
    const auto coordinate = [&](const Exact::FT& value) {
        return std::ldexp(nearest_double(value), -exponent);
    };
    return {coordinate(point.x()), coordinate(point.y()), coordinate(point.z())};
}

std::vector<int> find_repeated(std::span<const NamedPlane> planes,
                               const std::vector<Exact::Plane_3>& exact) {
    // Equal planes are close together when sorted by one component of the unit normal; only such
    // pairs are compared exactly.
    std::vector<std::pair<double, int>> order;
    for (std::size_t i = 0; i < planes.size(); ++i) {
        const Vec3& n = planes[i].plane.normal;
        order.emplace_back((0.36 * n.x + 0.48 * n.y + 0.8 * n.z) / glm::length(n),
                           static_cast<int>(i));
    }
    std::sort(order.begin(), order.end());
    std::vector<bool> is_repeated(planes.size(), false);
    for (std::size_t i = 0; i < order.size(); ++i) {
        for (std::size_t j = i; j-- > 0 && order[i].first - order[j].first < 1e-14;) {
            const int a = order[i].second, b = order[j].second;
            if (!is_repeated[b] && exact[a] == exact[b]) is_repeated[std::max(a, b)] = true;
        }
    }
    std::vector<int> repeated;
    for (std::size_t i = 0; i < planes.size(); ++i) {
        if (is_repeated[i]) repeated.push_back(static_cast<int>(i));
    }
    return repeated;
}

void require_directions(std::span<const NamedPlane> planes) {
    for (const NamedPlane& p : planes) {
        const double length = glm::length(p.plane.normal);
        if (!all_finite(p.plane.normal) || !std::isfinite(p.plane.offset) ||
            !std::isfinite(length)) {
            throw InputError(
                fmt::format("the plane of facet {} is not finite: give numbers", p.name));
        }
        if (!(length > 0)) {
            throw InputError(
                fmt::format("the plane of facet {} has no direction: its normal is zero", p.name));
        }
    }
}

}  // namespace

HalfSpaceSolid intersect_half_spaces(std::span<const NamedPlane> planes) {
    HalfSpaceSolid result;
    require_directions(planes);
    const int exponent = scale_exponent(planes);
    std::vector<Exact::Plane_3> exact;
    for (const NamedPlane& p : planes) exact.push_back(exact_plane(p.plane, exponent));
    result.repeated_planes = find_repeated(planes, exact);

    const int count = static_cast<int>(planes.size());
    const double box = std::ldexp(1.0, k_box_exponent);
    for (int axis = 0; axis < 3; ++axis) {
        for (const int sign : {1, -1}) {
            exact.emplace_back(axis == 0 ? sign : 0, axis == 1 ? sign : 0, axis == 2 ? sign : 0,
                               -box);
        }
    }
    Clipper clipper(std::move(exact));
    for (int i = 0; i < count; ++i) {
        if (std::binary_search(result.repeated_planes.begin(), result.repeated_planes.end(), i)) {
            continue;
        }
        check_stop();
        if (!clipper.clip(i)) {
            result.empty = true;
            return result;
        }
    }

    std::vector<const Face*> face_of_plane(planes.size(), nullptr);
    for (const Face& face : clipper.faces()) {
        // A solid that reaches the box is unbounded.
        if (face.plane >= count) {
            result.bounded = false;
            return result;
        }
        face_of_plane[face.plane] = &face;
    }
    std::unordered_map<int, int> vertex_of_corner;
    for (int i = 0; i < count; ++i) {
        if (face_of_plane[i] == nullptr) {
            if (!std::binary_search(result.repeated_planes.begin(), result.repeated_planes.end(),
                                    i)) {
                result.unused_planes.push_back(i);
            }
            continue;
        }
        Facet facet{planes[i].name, unit_plane(planes[i].plane), {}};
        for (const int corner : face_of_plane[i]->corners) {
            const auto [at, is_new] = vertex_of_corner.try_emplace(
                corner, static_cast<int>(result.solid.vertices.size()));
            if (is_new) result.solid.vertices.push_back(rounded(clipper.point(corner), exponent));
            facet.corners.push_back(at->second);
        }
        result.solid.facets.push_back(std::move(facet));
    }
    return result;
}

}  // namespace culet
