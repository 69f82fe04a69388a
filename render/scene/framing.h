#pragma once
// A stone seen square on, filling the picture: the camera of scenes that name none.

#include "render/scene/scene.h"

namespace culet {

/// Of the picture's side, what the stone's outline spans in the direction in which it fits tighter.
constexpr double k_framed_share = 0.85;

enum class Facing { crown, pavilion };

/// Sets position, target and width of `camera` (orthographic, from straight above or straight
/// below) so that the stone is framed; its picture size and `up` stay as they are. An `up` along
/// the view becomes +y. A solid without vertices changes nothing.
void frame_stone(const Solid& solid, Facing facing, Camera& camera);

}  // namespace culet
