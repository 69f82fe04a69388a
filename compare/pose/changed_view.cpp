#include "compare/pose/changed_view.h"

#include <ceres/jet.h>

#include "compare/pose/view_formulas.h"

namespace culet {

void ChangedView::set(const ViewChange& change) {
    using Jet = ceres::Jet<double, k_view_unknowns>;
    std::array<Jet, k_view_unknowns> c;
    for (std::size_t k = 0; k < c.size(); ++k) c[k] = Jet(change[k], static_cast<int>(k));
    const Jet scale = view_.scale * exp(c[5]), nearness = view_.nearness * exp(c[6]);
    const Jet sight_x = view_.sight.x + c[7], sight_y = view_.sight.y + c[8];
    const Jet beside_x = view_.at.x + c[3] - sight_x, beside_y = view_.at.y + c[4] - sight_y;
    const std::array<Jet, 9> turn = rotation_of(c[0], c[1], c[2]);
    const std::array<Jet, 9> aside =
        least_rotation_to(Jet(beside_x * nearness / scale), Jet(beside_y * nearness / scale));
    const auto numbers = [](const Jet& jet) {
        Number number;
        number[0] = jet.a;
        for (int k = 0; k < k_view_unknowns; ++k)
            number[static_cast<std::size_t>(1 + k)] = jet.v[k];
        return number;
    };
    beside_x_[0] = numbers(beside_x);
    beside_y_[0] = numbers(beside_y);
    depth_[0] = numbers(Jet(1.0));
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const Vec3& column = view_.turn[static_cast<int>(axis)];
        const std::array<Jet, 3> there = times(
            aside, times(turn, std::array<Jet, 3>{Jet(column.x), Jet(column.y), Jet(column.z)}));
        beside_x_[1 + axis] = numbers(scale * there[0]);
        beside_y_[1 + axis] = numbers(scale * there[1]);
        depth_[1 + axis] = numbers(nearness * there[2]);
    }
    sight_ = {sight_x.a, sight_y.a};
}

SeenPoint ChangedView::operator()(const Vec3& point) const {
    const Vec3 arm = point - view_.middle;
    const auto at_point = [&](const Linear& linear) {
        Number sum;
        for (std::size_t k = 0; k < sum.size(); ++k)
            sum[k] =
                linear[0][k] + linear[1][k] * arm.x + linear[2][k] * arm.y + linear[3][k] * arm.z;
        return sum;
    };
    const Number across = at_point(beside_x_), down = at_point(beside_y_), depth = at_point(depth_);
    const double per_depth = 1 / depth[0];
    const double x = across[0] * per_depth, y = down[0] * per_depth;
    SeenPoint seen;
    seen.at = {sight_.x + x, sight_.y + y};
    for (std::size_t k = 0; k < seen.x_by_change.size(); ++k) {
        seen.x_by_change[k] = (across[1 + k] - x * depth[1 + k]) * per_depth;
        seen.y_by_change[k] = (down[1 + k] - y * depth[1 + k]) * per_depth;
    }
    seen.x_by_change[7] += 1;
    seen.y_by_change[8] += 1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto i = static_cast<int>(axis);
        seen.x_by_point[i] = (beside_x_[1 + axis][0] - x * depth_[1 + axis][0]) * per_depth;
        seen.y_by_point[i] = (beside_y_[1 + axis][0] - y * depth_[1 + axis][0]) * per_depth;
    }
    return seen;
}

}  // namespace culet
