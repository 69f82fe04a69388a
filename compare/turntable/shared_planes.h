#pragma once
// By how much two outlines disagree at a plane that both touch, for ceres. Private to the folder.

#include <Eigen/Core>
#include <cmath>
#include <glm/vec2.hpp>
#include <numbers>
#include <type_traits>
#include <vector>

namespace culet {

using Hull = std::vector<glm::dvec2>;

template <class T>
using V3 = Eigen::Matrix<T, 3, 1>;

// The camera's axes for an outline: towards it, right and up in the picture.
template <class T>
struct View {
    V3<T> sight, right, up;
};
template <class T>
View<T> view_at(const T& turn, const T& elevation) {
    const T c = cos(elevation), s = sin(elevation);
    // When the stone turns one way, the camera goes round it the other way.
    const T x = cos(turn), y = -sin(turn);
    return {{c * x, c * y, s}, {-y, x, T(0)}, {-s * x, -s * y, c}};
}

// How far the outline reaches in a direction perpendicular to the line of sight.
template <class T>
T reach(const Hull& hull, const View<T>& view, const V3<T>& direction, const T* table) {
    const T x = view.right.dot(direction), y = view.up.dot(direction);
    const T c = cos(table[1]), s = sin(table[1]);
    // The direction in the picture, whose up is the axis, rotated by the roll.
    const T u = c * x + s * y, v = c * y - s * x;
    const auto number = [](const T& t) {
        if constexpr (std::is_same_v<T, double>)
            return t;
        else
            return t.a;
    };
    const double nu = number(u), nv = number(v);
    std::size_t far = 0;
    double most = -1e300;
    for (std::size_t i = 0; i < hull.size(); ++i) {
        const double d = nu * hull[i].x + nv * hull[i].y;
        if (d > most) {
            most = d;
            far = i;
        }
    }
    return u * (T(hull[far].x) - table[0]) + v * hull[far].y;
}

// Both outlines touch the plane through their lines of sight; `side`: +1 above, -1 below.
struct SharedPlane {
    const Hull *one, *other;
    double side;

    template <class T>
    bool operator()(const T* const table, const T* const turn_one, const T* const turn_other,
                    T* residual) const {
        const View<T> a = view_at(*turn_one, table[2]), b = view_at(*turn_other, table[2]);
        V3<T> normal = a.sight.cross(b.sight);
        normal /= normal.norm();
        if (normal.z() < T(0)) normal = -normal;
        normal *= T(side);
        residual[0] = reach(*one, a, normal, table) - reach(*other, b, normal, table);
        return true;
    }
};

// Half a turn apart: both touch the plane beside the axis.
struct OppositeReach {
    const Hull *one, *other;
    double side;

    template <class T>
    bool operator()(const T* const table, const T* const turn, T* residual) const {
        const View<T> a = view_at(*turn, table[2]),
                      b = view_at(T(*turn + std::numbers::pi), table[2]);
        const V3<T> normal = T(side) * a.right;
        residual[0] = reach(*one, a, normal, table) - reach(*other, b, normal, table);
        return true;
    }
};

}  // namespace culet
