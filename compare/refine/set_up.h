#pragma once
// How the set-up of a photograph may differ a little from the scene that stands for it.

#include <array>

#include "render/scene/scene.h"

namespace culet {

/// Angles in radians. Where the stone lies in the picture is not in it.
struct SetUp {
    /// The stone and the camera turned together in the light, about the scene's axes.
    std::array<double, 3> light{};
    /// The camera turned around the stone, about its picture's x (right) and y (down).
    std::array<double, 2> camera{};
};
constexpr std::size_t k_set_up_angles = 5;

/// One of the angles, the light's first.
double& angle_of(SetUp& set_up, std::size_t k);

/// The scene with that stone in that set-up, turned about `middle`.
Scene set_up_scene(const Scene& scene, const Solid& solid, const SetUp& set_up, const Vec3& middle);

}  // namespace culet
