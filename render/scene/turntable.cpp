#include "render/scene/turntable.h"

#include <glm/gtc/quaternion.hpp>

#include "render/scene/transform.h"

namespace culet {

Scene turned(const Scene& scene, double angle) {
    Scene turned = scene;
    Transform turn;
    turn.linear = glm::mat3_cast(glm::angleAxis(angle, scene.stone.up));
    const Vec3 middle = scene.has_stone() ? centroid(scene.stone.solid) : scene.camera.look_at;
    turn.move = middle - turn.linear * middle;
    move_stone(turn, turned.stone);
    for (Stone& stone : turned.more_stones) move_stone(turn, stone);
    for (SceneObject& object : turned.objects) move_shape(turn, object.shape);
    return turned;
}

}  // namespace culet
