#pragma once
// Where the light that a picture of a stone shows comes from.

#include <cstdint>
#include <functional>

#include "render/scene/scene.h"

namespace culet {

/// The end of one light path behind an eye ray.
struct SeenExit {
    std::uint32_t ray = 0;  ///< (y width + x) samples + sample
    Vec3 direction{0};      ///< unit, in which it leaves the stone
    double weight = 0;
};

/// The exits of a scene's ray table (ray_table.h; its first band), ray by ray; each ray that meets
/// the stone has one at least. The order does not depend on the number of threads.
void visit_exits(const Scene& scene, const std::function<void(const SeenExit&)>& visit);

}  // namespace culet
