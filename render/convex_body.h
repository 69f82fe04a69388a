#pragma once
// Where a ray meets a convex stone. Hits are decided by sign, without an epsilon.

#include <optional>
#include <vector>

#include "stone/solid.h"

namespace culet {

struct BodyHit {
    int facet = -1;
    double distance = 0;
};

/// The facet planes of a convex solid, laid out for searching.
class ConvexBody {
public:
    explicit ConvexBody(const Solid& solid);

    /// The facet through which a ray from outside enters; nothing when it misses, or starts inside.
    std::optional<BodyHit> entry(const Vec3& origin, const Vec3& direction) const;

    /// The facet through which a ray from inside leaves: of the planes that it runs towards, the
    /// nearest; of equally near ones the first. A start that rounding put outside a plane is taken
    /// as on it, so that a corner becomes two hits; the facet just left drops out because the ray
    /// runs away from it.
    BodyHit exit(const Vec3& origin, const Vec3& direction) const;

    bool contains(const Vec3& point) const;
    const Vec3& normal(int facet) const { return normals_[static_cast<std::size_t>(facet)]; }
    /// The point moved onto the facet's plane.
    Vec3 on_facet(int facet, const Vec3& point) const;

private:
    std::vector<Vec3> normals_;
    std::vector<double> nx_, ny_, nz_, offset_;
};

}  // namespace culet
