#include "compare/light_probe/even_directions.h"

#include <cmath>
#include <numbers>

namespace culet {

std::vector<Vec3> even_directions(int count) {
    std::vector<Vec3> result;
    const double golden = std::numbers::pi * (3 - std::sqrt(5.0));
    for (int i = 0; i < count; ++i) {
        const double z = 1 - (2.0 * i + 1) / count, r = std::sqrt(1 - z * z);
        result.emplace_back(r * std::cos(golden * i), r * std::sin(golden * i), z);
    }
    return result;
}

}  // namespace culet
