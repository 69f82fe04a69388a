#pragma once
// Stones and rays for tests of light paths.

#include <glm/geometric.hpp>
#include <random>
#include <vector>

#include "render/scene/scene.h"
#include "stone/solid/solid.h"
#include "tests/render/random_direction.h"

namespace culet {

// A random convex stone: planes tangent to an ellipsoid.
inline Solid random_stone(std::mt19937_64& random, int planes) {
    std::normal_distribution<double> normal;
    std::vector<NamedPlane> list;
    for (int axis = 0; axis < 3; ++axis) {
        for (int sign : {-1, 1}) {
            Vec3 n{0, 0, 0};
            n[axis] = sign;
            list.push_back({"box", {n, 1.3}});
        }
    }
    for (int i = 0; i < planes; ++i) {
        const Vec3 n = glm::normalize(Vec3{normal(random), normal(random), normal(random)});
        list.push_back({"p", {n, 1.0}});
    }
    return intersect_half_spaces(list).solid;
}

inline EyeRay random_ray(std::mt19937_64& random) {
    std::normal_distribution<double> normal;
    const Vec3 from = 5.0 * glm::normalize(Vec3{normal(random), normal(random), normal(random)});
    const Vec3 to = 0.5 * Vec3{normal(random), normal(random), normal(random)};
    return {from, glm::normalize(to - from)};
}

inline Solid slab(double thickness) {
    std::vector<NamedPlane> planes{{"top", {{0, 0, 1}, 0}}, {"bottom", {{0, 0, -1}, thickness}}};
    for (int axis = 0; axis < 2; ++axis) {
        for (int sign : {-1, 1}) {
            Vec3 n{0, 0, 0};
            n[axis] = sign;
            planes.push_back({"side", {n, 1e4}});
        }
    }
    return intersect_half_spaces(planes).solid;
}

}  // namespace culet
