#pragma once
// Divides an optical setup into passes over its beams.

#include <memory>
#include <vector>

#include "render/beams/strip_painter.h"
#include "render/setup/optical_setup.h"

namespace culet {

/// `stokes`: 1 for the radiance behind the eye's optics, 4 for the Stokes parameters; parameter k
/// of node i is in plane k * nodes + i. Each band of the setup has its own beams. `split`: a
/// crystal's two waves are followed separately.
std::vector<ShadingPass> shading_passes(const Scene& scene, const OpticalSetup& setup,
                                        const WavelengthSet& colours, const Vec3& middle,
                                        std::shared_ptr<const EnvironmentPyramid> environment,
                                        int stokes, bool split);

/// For each band the band whose beams it shares. `middle`, `size`: of the stone.
std::vector<std::size_t> shared_beams(const OpticalSetup& setup, const ScreenView& view,
                                      const Vec3& middle, double size, const BeamLimits& limits);

}  // namespace culet
