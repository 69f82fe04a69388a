#pragma once
// The wavelengths and path limits with which the GPU draws a scene.

#include "render/colour/colour.h"
#include "render/scene/scene.h"
#include "render/setup/optical_setup.h"

namespace culet {

struct GpuSetup {
    OpticalSetup optics;
    WavelengthSet colours;
    int depth = 0;          ///< most faces of a path
    double cut_weight = 0;  ///< paths of less weight end
};

/// From the scene's tolerance (reference/prepared_scene.h).
GpuSetup gpu_setup(const Scene& scene);

}  // namespace culet
