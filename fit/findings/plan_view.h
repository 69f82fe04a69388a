#pragma once
// A stone in plan: the hull of its corners, and its widths between calipers that are held level.
// Private to the room.

#include <vector>

#include "fit/model/residuals.h"

namespace culet {

/// Corners are indices of the outline's. It looks at shape and outline as long as it is asked.
class PlanView {
public:
    PlanView(const Shape& shape, const Outline& outline);

    /// That some facet has.
    const std::vector<int>& corners() const { return corners_; }
    const Vec3& place(int corner) const { return places_[std::size_t(corner)]; }
    /// Convex, counter-clockwise; corners less than rounding apart count as one.
    const std::vector<int>& hull() const { return hull_; }

    Quantity distance(int a, int b) const;
    Quantity perimeter() const;
    /// Between the two corners of the hull that lie furthest apart.
    Quantity widest() const;

    /// One jaw lies on an edge of the hull, the other touches a corner.
    struct Jaws {
        int from = -1, to = -1, opposite = -1;
        double width = 1e300;
    };
    /// The hull's edge whose opposite jaw stands nearest.
    Jaws narrowest() const;
    Quantity width(const Jaws& jaws) const;
    /// Extent of corners along the jaws (`across` false) or from jaw to jaw; the directions turn
    /// with the edge that one jaw lies on.
    Quantity extent(const Jaws& jaws, const std::vector<int>& corners, bool across) const;
    /// Mean distance of opposite corners of a loop.
    Quantity mean_across(const std::vector<int>& loop) const;

private:
    void find_hull();
    void put(Quantity& q, int corner, const Vec3& slope) const;
    Vec3 flat_between(int from, int to) const;
    double edge_length(const Jaws& jaws) const;
    Vec3 along(const Jaws& jaws) const;

    const Shape& shape_;
    const Outline& outline_;
    std::vector<Vec3> places_;
    std::vector<int> corners_, hull_;
};

}  // namespace culet
