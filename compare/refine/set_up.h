#pragma once
// How the set-up of a photograph may differ slightly from its scene.

#include <array>

#include "render/scene/scene.h"

namespace culet {

/// Angles in radians. The stone's place in the picture is not included.
struct SetUp {
    /// Rotation of stone and camera together, about the scene's axes.
    std::array<double, 3> light{};
    /// Rotation of the camera around the stone, about its picture's x (right) and y (down).
    std::array<double, 2> camera{};
};
constexpr std::size_t k_set_up_angles = 5;

/// One of the angles, the light's first.
double& angle_of(SetUp& set_up, std::size_t k);

/// The scene with `solid` in this set-up, rotated about `middle`.
Scene set_up_scene(const Scene& scene, const Solid& solid, const SetUp& set_up, const Vec3& middle);

}  // namespace culet
