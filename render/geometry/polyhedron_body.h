#pragma once
// Intersection of rays with a closed stone that need not be convex: hearts, notches, carved stones,
// facets with any outline. Watertight without an epsilon.
//
// For each ray every vertex is projected once, and every edge is tested once for the two facets
// that share it, with an exact sign (after Woop, Benthin and Wald, Watertight Ray/Triangle
// Intersection, JCGT 2(1), 2013). The ray thus meets an exactly closed surface, whose vertices
// differ from the stone's by the rounding of one projection. The steps (+1 in, -1 out) of a line
// always sum to 0, also along edges and through vertices, where half-open rules act like an
// infinitesimal shift of the ray. The winding of a facet's projected outline, not its normal, tells
// whether it is entered or left.
//
// Cost: a few nanoseconds for each vertex and edge.

#include <optional>
#include <span>
#include <vector>

#include "render/geometry/convex_body.h"
#include "stone/solid/solid.h"

namespace culet {

/// Where a line meets a facet.
struct LineCrossing {
    int facet = -1;
    int step = 0;  ///< +1 into the stone, -1 out of it (more for an outline wound repeatedly)
    double distance = 0;  ///< from the origin, in lengths of the direction; negative behind it
};

/// A closed solid that need not be convex. Distances are in lengths of the direction (any length)
/// and never negative. Rays may start on edges and vertices.
class PolyhedronBody {
public:
    /// Throws InputError if the facets do not close, edge by edge.
    explicit PolyhedronBody(const Solid& solid);

    /// Facet through which a ray from outside first enters; nothing if it misses, only touches, or
    /// starts inside.
    std::optional<BodyHit> entry(const Vec3& origin, const Vec3& direction) const;

    /// Facet where a ray exits that runs inwards from a point on facet `from` (-1: from anywhere
    /// inside). A start that rounding put outside is moved in by the shortest way, so a corner
    /// becomes two hits, the second at distance 0. Every start gets a facet.
    BodyHit exit(const Vec3& origin, const Vec3& direction, int from) const;

    /// Facet where a ray enters again that runs outwards from a point on facet `from` (-1: from
    /// anywhere outside); nothing if it escapes. Corners as in `exit`.
    std::optional<BodyHit> reentry(const Vec3& origin, const Vec3& direction, int from) const;

    /// False on the surface; within rounding of it, either answer is possible.
    bool contains(const Vec3& point) const;

    const Vec3& normal(int facet) const { return normals_[static_cast<std::size_t>(facet)]; }
    /// Projects the point onto the facet's plane.
    Vec3 on_facet(int facet, const Vec3& point) const;

    /// All crossings of the line, in both directions, by distance; at equal distance entering
    /// before leaving, then the lower facet. The steps sum to 0.
    std::vector<LineCrossing> crossings(const Vec3& origin, const Vec3& direction) const;

private:
    /// An edge from its lower to its higher vertex, once for each pair of facets that share it.
    struct Edge {
        int low, high;
        int along, against;  ///< facets whose outlines run from low to high, and from high to low
    };

    std::span<const LineCrossing> trace(const Vec3& origin, const Vec3& direction, int from) const;
    double distance_to(std::size_t facet, const Vec3& origin, const Vec3& direction) const;
    double miss_of(std::size_t facet, const Vec3& origin, const Vec3& direction) const;
    std::optional<BodyHit> run(const Vec3& origin, const Vec3& direction, int from,
                               bool inside) const;
    std::optional<BodyHit> run_from_beside(const Vec3& origin, const Vec3& direction, int from,
                                           bool inside,
                                           std::span<const LineCrossing> crossings) const;

    std::vector<double> coordinates_[3];
    std::vector<Vec3> normals_;
    std::vector<double> offsets_;
    std::vector<Edge> edges_;
    std::vector<std::vector<int>> corners_;         ///< of each facet
    std::vector<std::vector<int>> vertex_sharers_;  ///< per facet: the facets that share a vertex
                                                    ///< with it
    std::vector<int> all_;                          ///< all facets
    std::vector<bool> outermost_;  ///< facets with the whole stone behind their planes
};

}  // namespace culet
