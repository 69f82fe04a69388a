#pragma once
// Intersection of rays with a stone, convex or not.

#include <optional>

#include "render/geometry/convex_body.h"
#include "render/geometry/polyhedron_body.h"

namespace culet {

class StoneBody {
public:
    StoneBody(const Solid& solid, bool convex) : convex_(solid) {
        if (!convex) any_.emplace(solid);
    }

    bool convex() const { return !any_; }
    const ConvexBody& planes() const { return convex_; }

    std::optional<BodyHit> entry(const Vec3& origin, const Vec3& direction) const {
        return any_ ? any_->entry(origin, direction) : convex_.entry(origin, direction);
    }
    std::optional<BodyHit> entry(const Vec3& origin, const Vec3& direction,
                                 EntryGuess& last) const {
        return any_ ? any_->entry(origin, direction) : convex_.entry(origin, direction, last);
    }
    /// Inwards from facet `from`.
    BodyHit exit(const Vec3& origin, const Vec3& direction, int from) const {
        return any_ ? any_->exit(origin, direction, from) : convex_.exit(origin, direction);
    }
    /// Outwards from facet `from`; a non-convex stone may be hit again.
    std::optional<BodyHit> reentry(const Vec3& origin, const Vec3& direction, int from) const {
        return any_ ? any_->reentry(origin, direction, from) : std::nullopt;
    }
    bool contains(const Vec3& point) const {
        return any_ ? any_->contains(point) : convex_.contains(point);
    }
    bool has_ground() const { return convex_.has_ground(); }
    bool ground(int facet) const { return convex_.ground(facet); }
    const Vec3& normal(int facet) const { return convex_.normal(facet); }
    Vec3 on_facet(int facet, const Vec3& point) const { return convex_.on_facet(facet, point); }

private:
    ConvexBody convex_;
    std::optional<PolyhedronBody> any_;
};

}  // namespace culet
