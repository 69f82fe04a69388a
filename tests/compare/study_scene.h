#pragma once
// A small scene whose study takes seconds: a cube seen from a corner.

#include "render/scene/scene.h"
#include "stone/numbers/units.h"

namespace culet::test {

inline Scene cube_scene() {
    Scene scene;
    std::vector<NamedPlane> planes;
    const char* names[] = {"X", "x", "Y", "y", "T", "B"};
    for (int i = 0; i < 6; ++i) {
        Vec3 normal{0};
        normal[i / 2] = i % 2 == 0 ? 1 : -1;
        planes.push_back({names[i], {normal, 1}});
    }
    scene.stone.solid = intersect_half_spaces(planes).solid;
    scene.stone.name = "Cube";
    scene.stone.material = catalogue_material("glass_bk7");
    scene.camera.position = {6, 5, 9};
    scene.camera.width = scene.camera.height = 48;
    scene.camera.fov = radians(20);
    scene.lights.constant = 0.2;
    scene.lights.sources.push_back(CosinePowerLight{Vec3{0, 0, 1}, 4, {}});
    return scene;
}

}  // namespace culet::test
