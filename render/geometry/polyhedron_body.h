#pragma once
// Where a ray meets a closed stone that need not be convex: hearts, notches, carved stones, facets
// with any outline. Watertight without an epsilon.
//
// Along a ray every vertex is projected once, and every edge is judged once for the two facets that
// share it, with an exact sign (after the idea of Woop, Benthin and Wald, Watertight Ray/Triangle
// Intersection, JCGT 2(1), 2013). So what is intersected is exactly a closed surface, whose
// vertices differ from the stone's by the rounding of one projection: the steps (+1 in, -1 out) of
// a line through it add up to 0, always, also along edges and through vertices, where half-open
// rules act like an infinitesimal shift of the ray. Whether a facet is entered or left is read from
// the winding of its projected outline and not from its normal.
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
    double distance = 0;  ///< from the origin in lengths of the direction; negative behind it
};

/// The facets of a closed solid that need not be convex. Directions need not be unit; distances
/// count in lengths of the direction and are never negative. Rays may start on edges and vertices.
class PolyhedronBody {
public:
    /// Throws InputError when the facets do not close up, edge by edge.
    explicit PolyhedronBody(const Solid& solid);

    /// The facet through which a ray from outside enters first; nothing when it misses, only
    /// touches, or starts inside.
    std::optional<BodyHit> entry(const Vec3& origin, const Vec3& direction) const;

    /// From a point on facet `from` (-1: from anywhere inside), running inwards: where it leaves.
    /// A start that rounding put outside is taken as moved in by the shortest way, so that a corner
    /// becomes two hits, the second at distance 0. Returns a facet for every start whatever.
    BodyHit exit(const Vec3& origin, const Vec3& direction, int from) const;

    /// From a point on facet `from` (-1: from anywhere outside), running outwards: where it enters
    /// again; nothing when it goes free. Corners as in `exit`.
    std::optional<BodyHit> reentry(const Vec3& origin, const Vec3& direction, int from) const;

    /// Points on the surface do not count as inside; within rounding of it either answer may come.
    bool contains(const Vec3& point) const;

    const Vec3& normal(int facet) const { return normals_[static_cast<std::size_t>(facet)]; }
    /// The point moved onto the facet's plane.
    Vec3 on_facet(int facet, const Vec3& point) const;

    /// All crossings of the line, backwards too, in order of distance; at equal distance entering
    /// before leaving, then the lower facet. The steps add up to 0.
    std::vector<LineCrossing> crossings(const Vec3& origin, const Vec3& direction) const;

private:
    /// An edge from the lower to the higher vertex, once for each pair of facets that share it.
    struct Edge {
        int low, high;
        int along, against;  ///< the facets whose outlines run from low to high and back
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
    std::vector<std::vector<int>> vertex_sharers_;  ///< facets that share a vertex with each facet
    std::vector<int> all_;                          ///< all facets
    std::vector<bool> outermost_;  ///< facets behind whose planes the whole stone lies
};

}  // namespace culet
