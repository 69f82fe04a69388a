#pragma once
// Divides the wavelengths of a setup into passes of the kernel, with their uniforms.

#include "render/beams/beam_lights.h"
#include "render/gpu/gpu_program.h"
#include "render/gpu/light_counts.h"

namespace culet {

/// Wavelengths that share one path.
struct GpuPath {
    std::size_t band = 0;
    int first = 0, count = 1;  ///< of the setup's wavelengths
};

/// Layout of a setup's wavelengths.
struct GpuLayout {
    int nodes = 1;  ///< per path, padding included
    int paths = 1;  ///< most per pass
    bool crystal = false, absorbs = false;
    std::vector<GpuPath> all;
};

GpuLayout gpu_layout(const OpticalSetup& setup, const LightCounts& lights, int pass_wavelengths);

/// Most uniform vectors (of four) of passes with one path, and the limit: WebGL2 guarantees 224 to
/// a fragment shader.
int gpu_vectors(const LightCounts& lights);
constexpr int k_most_gpu_vectors = 200;

/// The passes in order of wavelength. `environment`: the scene has one.
std::vector<GpuPass> gpu_passes(const OpticalSetup& setup, const WavelengthSet& colours,
                                const GpuLayout& layout, const ShadedLights& lights,
                                bool environment);

}  // namespace culet
