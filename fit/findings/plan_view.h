#pragma once
// A stone in plan: the hull of its corners, and its widths between calipers that are held level.
// Private to the room.

#include <vector>

#include "fit/model/residuals.h"

namespace culet {

/// Arithmetic with derivatives.
Quantity operator+(Quantity a, const Quantity& b);
Quantity operator-(Quantity a, const Quantity& b);
Quantity operator*(double factor, const Quantity& a);
Quantity operator*(const Quantity& a, const Quantity& b);
Quantity operator/(const Quantity& a, const Quantity& b);

/// Corners are indices of the outline's. It looks at shape and outline as long as it is asked.
class PlanView {
public:
    PlanView(const Shape& shape, const Outline& outline);

    /// That some facet has.
    const std::vector<int>& corners() const { return corners_; }
    const Vec3& place(int corner) const { return places_[std::size_t(corner)]; }
    Quantity along(int corner, const Vec3& direction) const;
    /// Convex, counter-clockwise; corners less than rounding apart count as one.
    const std::vector<int>& hull() const { return hull_; }

    Quantity perimeter() const;
    /// Between the two corners of the hull that lie furthest apart.
    Quantity widest() const;
    /// Mean distance of opposite corners of a loop.
    Quantity mean_across(const std::vector<int>& loop) const;

    /// The hull's edge that one jaw lies on, where the opposite jaw stands nearest.
    struct Jaws {
        int from = -1, to = -1;
        double width = 1e300;
    };
    Jaws narrowest() const;
    /// Extent of corners along the jaws (`across` false) or from jaw to jaw; the directions turn
    /// with the edge that one jaw lies on.
    Quantity extent(const Jaws& jaws, const std::vector<int>& corners, bool across) const;

private:
    struct Flat {
        Quantity x, y;
    };
    Flat between(int from, int to) const;
    Quantity distance(int a, int b) const;
    void find_hull();

    const Shape& shape_;
    const Outline& outline_;
    std::vector<Vec3> places_;
    std::vector<int> corners_, hull_;
};

}  // namespace culet
