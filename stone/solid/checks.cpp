#include "stone/solid/checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

#include "stone/solid/outline.h"
#include "stone/solid/surface_edges.h"

namespace culet {

namespace {

constexpr int k_most_listed = 20;
constexpr int k_most_parts_told = 4;

// Angle in radians, and offset / diameter: far above the rounding of doubles, far below what a
// cutter could tell apart.
constexpr double k_same_plane = 1e-9;

bool is_finite(const Vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

class FaultFinder {
public:
    FaultFinder(const Solid& solid, const CheckLimits& limits) : solid_(solid), limits_(limits) {}

    std::vector<Fault> find() {
        if (solid_.facets.empty()) {
            add(FaultKind::empty, "the file has no facets");
            return faults_;
        }
        const bool sound_numbers = check_numbers();
        if (!has_valid_corners(solid_)) {
            add(FaultKind::degenerate_facet, "a facet names a vertex that does not exist");
            return faults_;
        }
        const bool whole_surface = check_surface();
        check_names();
        check_unused();
        if (sound_numbers) check_shape(whole_surface);
        return sorted();
    }

private:
    void add(FaultKind kind, std::string what) { faults_.push_back({kind, std::move(what)}); }
    const std::string& name(int facet) const { return solid_.facets[facet].name; }

    bool check_numbers() {
        bool sound = true;
        for (std::size_t v = 0; v < solid_.vertices.size(); ++v) {
            if (is_finite(solid_.vertices[v])) continue;
            sound = false;
            add(FaultKind::not_finite,
                fmt::format("a coordinate of vertex v{} is not a finite number", v));
        }
        for (const Facet& facet : solid_.facets) {
            if (is_finite(facet.plane.normal) && std::isfinite(facet.plane.offset)) continue;
            sound = false;
            add(FaultKind::not_finite,
                fmt::format("the plane of facet {} is not finite", facet.name));
        }
        return sound;
    }

    bool check_surface() {
        bool whole = true;
        for (const Facet& facet : solid_.facets) {
            if (has_distinct_corners(facet)) continue;
            whole = false;
            add(FaultKind::degenerate_facet,
                fmt::format("facet {} has {} corners, of which at least three must be distinct and "
                            "none may come twice",
                            facet.name, facet.corners.size()));
        }
        const std::vector<EdgeSide> edges = sorted_sides(solid_);
        Groups pieces(solid_.facets.size());
        for (std::size_t i = 0, end = 0; i < edges.size(); i = end) {
            for (end = i; end < edges.size() && edges[i].same_edge(edges[end]); ++end) {
                pieces.join(edges[i].facet, edges[end].facet);
            }
            const std::string where = fmt::format("edge v{}-v{}", edges[i].low, edges[i].high);
            if (end - i == 1) {
                add(FaultKind::open, fmt::format("{} of facet {} has no facet on its other side",
                                                 where, name(edges[i].facet)));
            } else if (end - i > 2) {
                add(FaultKind::not_manifold,
                    fmt::format("{} has {} facets: {}, {}, {} ...", where, end - i,
                                name(edges[i].facet), name(edges[i + 1].facet),
                                name(edges[i + 2].facet)));
            } else if (edges[i].forward == edges[i + 1].forward) {
                add(FaultKind::misoriented,
                    fmt::format("facets {} and {} run the same way along {}: one of them is "
                                "inside out",
                                name(edges[i].facet), name(edges[i + 1].facet), where));
            } else {
                continue;
            }
            whole = false;
        }
        for (const int vertex : pinched_vertices(solid_, edges)) {
            whole = false;
            add(FaultKind::not_manifold,
                fmt::format("parts of the surface touch only at vertex v{}", vertex));
        }
        check_pieces(pieces);
        return whole;
    }

    void check_pieces(Groups& pieces) {
        // Keyed by the first facet of each part.
        std::map<int, int> first_of, sizes;
        for (int f = 0; f < static_cast<int>(solid_.facets.size()); ++f)
            ++sizes[first_of.try_emplace(pieces.find(f), f).first->second];
        if (sizes.size() < 2) return;
        is_one_piece_ = false;
        std::string parts;
        int told = 0;
        for (const auto& [first, count] : sizes) {
            if (++told > k_most_parts_told) {
                parts += ", ...";
                break;
            }
            parts += fmt::format("{}one of {} from facet {} on", told == 1 ? "" : ", ", count,
                                 name(first));
        }
        add(FaultKind::several_pieces,
            fmt::format(
                "the facets form {} parts that share no edge ({}): keep the one that is the "
                "stone",
                sizes.size(), parts));
    }

    void check_names() {
        std::vector<std::string> names;
        for (const Facet& facet : solid_.facets) names.push_back(facet.name);
        std::sort(names.begin(), names.end());
        for (std::size_t i = 0, end = 0; i < names.size(); i = end) {
            for (end = i; end < names.size() && names[end] == names[i];) ++end;
            if (end - i > 1) {
                add(FaultKind::repeated_name,
                    fmt::format("{} facets are named {}", end - i, names[i]));
            }
        }
    }

    void check_unused() {
        std::vector<bool> used(solid_.vertices.size(), false);
        for (const Facet& facet : solid_.facets) {
            for (const int corner : facet.corners) used[corner] = true;
        }
        for (std::size_t v = 0; v < used.size(); ++v) {
            if (!used[v]) {
                add(FaultKind::unused_vertex, fmt::format("vertex v{} belongs to no facet", v));
            }
        }
    }

    void check_shape(bool whole_surface) {
        const double size = diameter(solid_);
        const double allowed = std::max(limits_.planarity * size, coordinate_rounding(solid_));
        for (const Facet& facet : solid_.facets) {
            if (!has_distinct_corners(facet)) continue;
            std::vector<Vec3> loop;
            for (const int corner : facet.corners) loop.push_back(solid_.vertices[corner]);
            const CornerTriple corners = spread_corners(solid_, facet);
            if (!(corners.width > 1e-15 * size)) {
                add(FaultKind::degenerate_facet, fmt::format("facet {} has no area", facet.name));
                continue;
            }
            double worst = 0;
            for (const Vec3& corner : loop) {
                worst = std::max(worst, std::abs(height_above(facet.plane, corner)));
            }
            if (!(worst <= allowed)) {
                add(FaultKind::not_planar,
                    fmt::format("a corner of facet {} lies {:.3g} off its plane ({:.2g} of the "
                                "diameter; {:.2g} is allowed)",
                                facet.name, worst, worst / size, allowed / size));
            }
            // Not by the area vector, which is zero for a figure of eight.
            const Vec3 across = glm::cross(corners.b - corners.a, corners.c - corners.a);
            if (crosses_itself(flat_outline(solid_, facet, across))) {
                add(FaultKind::self_crossing,
                    fmt::format("the outline of facet {} crosses itself", facet.name));
            }
        }
        if (whole_surface && volume(solid_) < 0) {
            add(FaultKind::inside_out,
                "the facets run clockwise as seen from outside: the volume is negative");
        } else if (whole_surface && is_one_piece_ && limits_.must_be_convex && !is_convex(solid_)) {
            tell_concave_edges();
        }
        if (limits_.must_be_convex && is_one_piece_) check_repeated_planes(size);
    }

    void tell_concave_edges() {
        // The stored planes serve to name the edges; the exact test decides.
        const std::vector<EdgeSide> edges = sorted_sides(solid_);
        const double forgiven = std::min(planarity(solid_), k_largest_miss * diameter(solid_));
        bool told = false;
        for (std::size_t i = 1; i < edges.size(); ++i) {
            if (!edges[i - 1].same_edge(edges[i])) continue;
            const Facet& left = solid_.facets[edges[i - 1].facet];
            const Facet& right = solid_.facets[edges[i].facet];
            double highest = 0;
            for (const int corner : right.corners) {
                highest = std::max(highest, height_above(left.plane, solid_.vertices[corner]));
            }
            if (highest <= forgiven) continue;
            told = true;
            add(FaultKind::not_convex,
                fmt::format("facet {} rises {:.3g} above the plane of its neighbour {}", right.name,
                            highest, left.name));
        }
        for (const Facet& facet : solid_.facets) {
            if (told) return;
            const std::vector<Vec2> outline = flat_outline(solid_, facet, facet.plane.normal);
            if (is_convex_outline(outline, forgiven)) continue;
            told = true;
            add(FaultKind::not_convex,
                fmt::format("the outline of facet {} is not convex", facet.name));
        }
        if (!told) {
            add(FaultKind::not_convex, "the surface winds round its inside more than once");
        }
    }

    void check_repeated_planes(double size) {
        std::vector<int> order(solid_.facets.size());
        std::iota(order.begin(), order.end(), 0);
        const auto& plane = [&](int f) -> const Plane& { return solid_.facets[f].plane; };
        // Sorted along an arbitrary direction, equal normals become neighbours.
        const auto key = [&](int f) { return glm::dot(plane(f).normal, Vec3(0.36, 0.48, 0.8)); };
        std::sort(order.begin(), order.end(),
                  [&](int a, int b) { return std::pair(key(a), a) < std::pair(key(b), b); });
        const std::size_t most = faults_.size() + 1000;
        for (std::size_t i = 0; i < order.size() && faults_.size() < most; ++i) {
            for (std::size_t j = i + 1; j < order.size(); ++j) {
                const Plane &a = plane(order[i]), &b = plane(order[j]);
                if (key(order[j]) - key(order[i]) > k_same_plane) break;
                if (glm::length(a.normal - b.normal) > k_same_plane) continue;
                const Vec3& corner = solid_.vertices[solid_.facets[order[j]].corners.empty()
                                                         ? 0
                                                         : solid_.facets[order[j]].corners[0]];
                // Heights, not offsets: far from the origin offsets depend on the last digit of the
                // normals.
                if (std::abs(height_above(a, corner) - height_above(b, corner)) >
                    k_same_plane * size) {
                    continue;
                }
                add(FaultKind::repeated_plane, fmt::format("facets {} and {} lie in one plane",
                                                           name(order[i]), name(order[j])));
            }
        }
    }

    std::vector<Fault> sorted() {
        std::stable_sort(faults_.begin(), faults_.end(),
                         [](const Fault& a, const Fault& b) { return a.kind < b.kind; });
        std::vector<Fault> told;
        for (std::size_t i = 0, end = 0; i < faults_.size(); i = end) {
            for (end = i; end < faults_.size() && faults_[end].kind == faults_[i].kind; ++end) {
                if (end - i < k_most_listed) told.push_back(faults_[end]);
            }
            if (end - i > k_most_listed) {
                told.push_back(
                    {faults_[i].kind, fmt::format("and {} more", end - i - k_most_listed)});
            }
        }
        return told;
    }

    const Solid& solid_;
    const CheckLimits& limits_;
    std::vector<Fault> faults_;
    bool is_one_piece_ = true;
};

}  // namespace

std::vector<Fault> find_faults(const Solid& solid, const CheckLimits& limits) {
    return FaultFinder(solid, limits).find();
}

bool is_closed(const Solid& solid) {
    if (solid.facets.empty() || !has_valid_corners(solid) ||
        !std::all_of(solid.vertices.begin(), solid.vertices.end(), is_finite) ||
        !std::all_of(solid.facets.begin(), solid.facets.end(), has_distinct_corners)) {
        return false;
    }
    const std::vector<EdgeSide> edges = sorted_sides(solid);
    for (std::size_t i = 0; i < edges.size(); i += 2) {
        if (i + 1 == edges.size() || !edges[i].same_edge(edges[i + 1]) ||
            edges[i].forward == edges[i + 1].forward ||
            (i + 2 < edges.size() && edges[i].same_edge(edges[i + 2]))) {
            return false;
        }
    }
    return pinched_vertices(solid, edges).empty();
}

double coordinate_rounding(const Solid& solid) {
    double reach = 0;
    for (const Vec3& v : solid.vertices) reach = std::max(reach, glm::length(v));
    return 4 * std::numeric_limits<double>::epsilon() * reach;
}

const char* name_of(FaultKind kind) {
    switch (kind) {
        case FaultKind::empty:
            return "empty";
        case FaultKind::not_finite:
            return "not_finite";
        case FaultKind::degenerate_facet:
            return "degenerate_facet";
        case FaultKind::open:
            return "open";
        case FaultKind::not_manifold:
            return "not_manifold";
        case FaultKind::misoriented:
            return "misoriented";
        case FaultKind::inside_out:
            return "inside_out";
        case FaultKind::several_pieces:
            return "several_pieces";
        case FaultKind::not_planar:
            return "not_planar";
        case FaultKind::not_convex:
            return "not_convex";
        case FaultKind::self_crossing:
            return "self_crossing";
        case FaultKind::unused_vertex:
            return "unused_vertex";
        case FaultKind::repeated_name:
            return "repeated_name";
        case FaultKind::missing_facet:
            return "missing_facet";
        case FaultKind::repeated_plane:
            return "repeated_plane";
    }
    return "unknown";
}

}  // namespace culet
