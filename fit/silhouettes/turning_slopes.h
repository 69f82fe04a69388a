#pragma once
// How a place's picture follows place, camera and turn. Private to the room.

#include <glm/geometric.hpp>

#include "fit/silhouettes/turning_camera.h"

namespace culet {

/// Derivatives of (nx, ny) . place_in_picture.
struct PictureSlopes {
    Vec3 by_place{0, 0, 0};
    double by_axis = 0, by_roll = 0, by_elevation = 0, by_perspective = 0, by_turn = 0;
};
PictureSlopes picture_slopes(const TurningCamera& camera, double turn, double nx, double ny,
                             const Vec3& place);

}  // namespace culet
