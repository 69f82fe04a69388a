#include "render/gpu/gpu_setup.h"

#include <utility>

#include "render/reference/prepared_scene.h"

namespace culet {

GpuSetup gpu_setup(const Scene& scene) {
    PreparedScene prepared(scene);
    return {std::move(prepared.setup), std::move(prepared.colours), prepared.limits.depth,
            prepared.limits.cut_weight};
}

}  // namespace culet
