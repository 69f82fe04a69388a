#pragma once
// The wavelengths of a setup as passes of the kernel, and their uniforms.

#include "render/beams/beam_lights.h"
#include "render/gpu/gpu_program.h"
#include "render/gpu/light_counts.h"

namespace culet {

/// Wavelengths that go one way together.
struct GpuPath {
    std::size_t band = 0;
    int first = 0, count = 1;  ///< of the setup's wavelengths
};

/// How a setup's wavelengths are laid out.
struct GpuLayout {
    int nodes = 1;  ///< of a path, absent ones included
    int paths = 1;  ///< of a pass at most
    bool crystal = false, absorbs = false;
    std::vector<GpuPath> all;
};

GpuLayout gpu_layout(const OpticalSetup& setup, const LightCounts& lights, int pass_wavelengths);

/// Uniforms that passes of one path take at most, in vectors of four, and how many there may be:
/// WebGL2 promises 224 to a fragment shader.
int gpu_vectors(const LightCounts& lights);
constexpr int k_most_gpu_vectors = 200;

/// The passes, in the order of the wavelengths. `environment`: there is one.
std::vector<GpuPass> gpu_passes(const OpticalSetup& setup, const WavelengthSet& colours,
                                const GpuLayout& layout, const ShadedLights& lights,
                                bool environment);

}  // namespace culet
