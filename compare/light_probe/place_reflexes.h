#pragma once
// Reflexes of lights in one place's ball, and what they say of the light's edge.

#include <string>
#include <vector>

#include "compare/light_probe/near_light.h"
#include "compare/light_probe/reflex.h"

namespace culet {

EdgeSight sight_in_world(const BallPlace& place, const MirrorBall::Reflection& reflection);
SeenOutline outline_of(const BallPlace& place, const Reflex& reflex);

/// `where`: the pixel, for the message of the InputError when there is no reflex.
Reflex reflex_or_refuse(const BallPlace& place, const PixelPlace& seed, const std::string& where);

/// Where a picture may show what another place sees along a line: its brightest pixels on and
/// beside the line, over all distances.
std::vector<Reflex> reflexes_along(const BallPlace& place, const EdgeSight& line, double bright);

}  // namespace culet
