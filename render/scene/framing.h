#pragma once
// The camera of scenes that name none: it looks straight at the stone, which fills the picture.

#include "render/scene/scene.h"

namespace culet {

/// Part of the picture's side that the stone's outline spans, in the tighter direction.
constexpr double k_framed_share = 0.85;
/// A photographer's camera: degrees from straight above towards -y, and the vertical field of view,
/// of a lens of 105 mm on a full frame.
constexpr double k_photograph_tilt_deg = 12, k_photograph_fov_deg = 13;

/// Unit vector.
Vec3 direction_to_photographer();

/// Straight above or below the stone, or as in a photograph: tilted, in perspective.
enum class Facing { crown, pavilion, photograph };

/// Places `camera` so that the stone fills the picture; above and below, it is orthographic. Keeps
/// the picture size, and `up` unless it runs along the view (then +y). Does nothing for a solid
/// without vertices.
void frame_stone(const Solid& solid, Facing facing, Camera& camera);

}  // namespace culet
