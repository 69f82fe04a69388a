#pragma once
// What a plan calls for, as passes over its beams.

#include <memory>
#include <vector>

#include "render/beams/strip_painter.h"
#include "render/setup/optical_setup.h"

namespace culet {

/// `stokes`: 1, the radiance behind the eye's optics, or 4, the Stokes parameters; plane of
/// parameter k and node i: k * nodes + i. Every band of the plan has beams of its own.
/// `split`: the two waves of a crystal go their own ways.
std::vector<ShadingPass> shading_passes(const Scene& scene, const OpticalSetup& setup,
                                        const WavelengthSet& colours, const Vec3& middle,
                                        std::shared_ptr<const EnvironmentPyramid> environment,
                                        int stokes, bool split);

}  // namespace culet
