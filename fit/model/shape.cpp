#include "fit/model/shape.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "stone/errors.h"

namespace culet {

Layout layout_of(const Shape& shape) {
    return {static_cast<int>(shape.normals.size()), static_cast<int>(shape.points.size()),
            static_cast<int>(shape.extras.size())};
}

// Duff et al., Building an Orthonormal Basis, Revisited (JCGT 2017).
std::array<Vec3, 2> tangents(const Vec3& n) {
    const double sign = std::copysign(1.0, n.z);
    const double a = -1 / (sign + n.z), b = n.x * n.y * a;
    return {Vec3{1 + sign * n.x * n.x * a, sign * b, -sign * n.x},
            Vec3{b, sign + n.y * n.y * a, -n.y}};
}

Shape retracted(const Shape& shape, std::span<const double> step) {
    const Layout layout = layout_of(shape);
    check(static_cast<int>(step.size()) == layout.size(), "a step of another layout");
    Shape next = shape;
    for (int f = 0; f < layout.facets; ++f) {
        const auto [t, u] = tangents(shape.normals[f]);
        const double a = step[layout.tilt(f)], b = step[layout.tilt(f) + 1];
        if (a != 0 || b != 0) next.normals[f] = glm::normalize(shape.normals[f] + a * t + b * u);
        next.offsets[f] += step[layout.offset(f)];
    }
    for (int p = 0; p < layout.points; ++p) {
        const int at = layout.point(p);
        next.points[p] += Vec3{step[at], step[at + 1], step[at + 2]};
    }
    for (int e = 0; e < layout.extras; ++e) next.extras[e] += step[layout.extra(e)];
    return next;
}

}  // namespace culet
