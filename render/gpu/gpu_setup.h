#pragma once
// What a GPU program draws of a scene: wavelengths, and how far paths are followed.

#include "render/colour/colour.h"
#include "render/scene/scene.h"
#include "render/setup/optical_setup.h"

namespace culet {

struct GpuSetup {
    OpticalSetup optics;
    WavelengthSet colours;  ///< of its wavelengths
    int depth = 0;          ///< faces of a path at most
    double cut_weight = 0;  ///< a path of less weight is not followed
};

/// As the scene's tolerance leaves them (reference/prepared_scene.h).
GpuSetup gpu_setup(const Scene& scene);

}  // namespace culet
