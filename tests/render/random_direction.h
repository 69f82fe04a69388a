// A uniformly distributed direction.
#pragma once

#include <glm/geometric.hpp>
#include <random>

#include "stone/solid/solid.h"

namespace culet {

inline Vec3 random_direction(std::mt19937_64& random) {
    std::normal_distribution<double> normal;
    return glm::normalize(Vec3{normal(random), normal(random), normal(random)});
}

}  // namespace culet
