#pragma once
// The camera of scenes that name none: it looks straight at the stone, which fills the picture.

#include "render/scene/scene.h"

namespace culet {

/// Part of the picture's side that the outline spans, in the direction in which it fits more
/// tightly.
constexpr double k_framed_share = 0.85;

enum class Facing { crown, pavilion };

/// Makes `camera` orthographic, straight above or below the stone, with the stone framed. The
/// picture size stays, and so does `up` unless it runs along the view: it becomes +y then. A solid
/// without vertices changes nothing.
void frame_stone(const Solid& solid, Facing facing, Camera& camera);

}  // namespace culet
