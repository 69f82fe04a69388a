#include "fit/model/inclination_side.h"

#include <cmath>
#include <numbers>

#include "stone/numbers/units.h"

namespace culet {

namespace {

bool is_nearly_upright(const Vec3& normal) {
    return std::abs(normal.z) < std::sin(radians(5));
}

}  // namespace

int side_of(const Vec3& normal, double inclination_read) {
    const int side = normal.z < 0 ? -1 : 1;
    const double from_up = std::atan2(std::hypot(normal.x, normal.y), side * normal.z);
    const double from_down = std::numbers::pi - from_up;
    return is_nearly_upright(normal) &&
                   std::abs(from_down - inclination_read) < std::abs(from_up - inclination_read)
               ? -side
               : side;
}

}  // namespace culet
