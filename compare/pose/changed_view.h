#pragma once
// A changing view, computed once for all projected points.

#include <array>

#include "compare/pose/stone_view.h"

namespace culet {

/// A point's place in the picture, with derivatives by view and point.
struct SeenPoint {
    PicturePoint at;
    std::array<double, k_view_unknowns> x_by_change, y_by_change;
    Vec3 x_by_point, y_by_point;
};

class ChangedView {
public:
    explicit ChangedView(const StoneView& view) : view_(view) { set({}); }
    /// A point then costs some 150 multiplications.
    void set(const ViewChange& change);
    SeenPoint operator()(const Vec3& point) const;

private:
    // A number and its derivatives by the change.
    using Number = std::array<double, 1 + k_view_unknowns>;
    // c[0] + c[1] x + c[2] y + c[3] z of the point, relative to the stone's middle.
    using Linear = std::array<Number, 4>;
    StoneView view_;
    Linear beside_x_, beside_y_, depth_;
    PicturePoint sight_;
};

}  // namespace culet
