#pragma once
// Small scenes for the plain shadings.

#include <cmath>
#include <glm/geometric.hpp>
#include <utility>
#include <vector>

#include "render/scene/scene.h"

namespace culet::test {

inline SceneObject sphere(SurfaceMaterial material, double radius = 1) {
    return {SphereShape{{0, 0, 0}, radius}, std::move(material)};
}

inline DiffuseMaterial diffuse(double albedo) {
    return {SurfaceColour{albedo}};
}

// Seen from +z with parallel rays; no stone.
inline Scene scene_of_objects(std::vector<SceneObject> objects, double width = 2.5) {
    Scene scene;
    scene.objects = std::move(objects);
    scene.camera.position = {0, 0, 10};
    scene.camera.orthographic_width = width;
    scene.camera.width = scene.camera.height = 25;
    scene.settings.samples = 1;
    return scene;
}

// A distant light from `toward` with irradiance pi on a surface that faces it: a cap of radiance 1
// / sin^2(half angle).
inline Light sun(const Vec3& toward) {
    DiscLight cap;
    cap.direction = glm::normalize(toward);
    cap.to = 0.01;
    cap.radiance.value = 1 / std::pow(std::sin(0.01), 2);
    return cap;
}

inline EyeRay down(double x, double y) {
    return {{x, y, 10}, {0, 0, -1}};
}

}  // namespace culet::test
