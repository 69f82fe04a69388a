#pragma once
// Where a ray meets a closed stone that need not be convex: hearts, carved stones, stones with a
// cleavage broken out.
//
// The vertices are projected along the ray, each once, so that facets which share a vertex or an
// edge see the same numbers. The ray's line crosses a facet when the winding number of the
// projected outline about it is not 0; an edge's share in it is decided by one sign, the same for
// its two facets. So the signed crossings of any line add up to exactly 0: nothing leaks through an
// edge or a vertex, and there is no epsilon. Positions along the line only put the crossings in
// order; where rounding swaps two that all but touch, the running count tells.

#include <optional>
#include <vector>

#include "render/convex_body.h"

namespace culet {

class PolyhedronBody {
public:
    explicit PolyhedronBody(const Solid& solid);

    /// The facet through which a ray from outside enters; nothing when it misses, or starts inside.
    std::optional<BodyHit> entry(const Vec3& origin, const Vec3& direction) const;

    /// Where a ray leaves that starts inwards from a point on facet `from` (-1: from a point
    /// inside). There always is such a facet; distances are never negative.
    BodyHit exit(const Vec3& origin, const Vec3& direction, int from) const;

    /// Where a ray that starts outwards from a point on facet `from` meets the stone again.
    std::optional<BodyHit> reentry(const Vec3& origin, const Vec3& direction, int from) const;

    bool contains(const Vec3& point) const;

    /// A crossing of the line with a facet: `sign` +1 where it leaves the stone, -1 where it
    /// enters.
    struct Crossing {
        double t = 0;
        int facet = -1, sign = 0;
    };
    /// All crossings of the ray's line, in order; entering first where two are equally far.
    void cross(const Vec3& origin, const Vec3& direction, std::vector<Crossing>& crossings) const;

private:
    struct Face {
        Plane plane;
        int first = 0, count = 0;  // in corners_
        Vec3 center{0, 0, 0};
        double radius = 0;
    };
    std::vector<Vec3> vertices_;
    std::vector<int> corners_;
    std::vector<Face> faces_;
};

}  // namespace culet
