#include "compare/refine/set_up.h"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include "compare/scores/chance.h"
#include "render/scene/transform.h"
#include "stone/numbers/units.h"

namespace culet {

namespace {

void turn_about(Camera& camera, const glm::dmat3& turn, const Vec3& middle) {
    camera.position = turn * (camera.position - middle) + middle;
    camera.look_at = turn * (camera.look_at - middle) + middle;
    camera.up = turn * camera.up;
}

}  // namespace

double& angle_of(SetUp& set_up, std::size_t k) {
    return k < 3 ? set_up.light[k] : set_up.camera[k - 3];
}

Scene set_up_scene(const Scene& scene, const Solid& solid, const SetUp& set_up,
                   const Vec3& middle) {
    Scene result = scene;
    const glm::dmat3 together =
        rotation_of({degrees(set_up.light[0]), degrees(set_up.light[1]), degrees(set_up.light[2])});
    result.stone.solid = solid;
    move_stone({together, middle - together * middle}, result.stone);
    Camera& camera = result.camera;
    turn_about(camera, together, middle);
    const Vec3 ahead = glm::normalize(camera.look_at - camera.position);
    const Vec3 right = glm::normalize(glm::cross(ahead, camera.up));
    const Vec3 down = glm::cross(ahead, right);
    turn_about(camera,
               rotation_about(right, set_up.camera[0]) * rotation_about(down, set_up.camera[1]),
               middle);
    return result;
}

}  // namespace culet
