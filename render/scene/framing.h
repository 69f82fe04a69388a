#pragma once
// The camera of scenes that name none: it looks straight at the stone, which fills the picture.

#include "render/scene/scene.h"

namespace culet {

/// Part of the picture's side that the stone's outline spans, in the tighter direction.
constexpr double k_framed_share = 0.85;

enum class Facing { crown, pavilion };

/// Makes `camera` orthographic, straight above or below the framed stone. Keeps the picture size,
/// and `up` unless it runs along the view (then +y). Does nothing for a solid without vertices.
void frame_stone(const Solid& solid, Facing facing, Camera& camera);

}  // namespace culet
