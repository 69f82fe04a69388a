#include "fit/model/shape.h"

#include <cmath>

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

}  // namespace culet
