#pragma once
// A convex stone as a GPU program: GLSL ES 3.00 for OpenGL ES 3 and WebGL2. Makes no GL calls.
//
// The kernel draws light paths of one eye ray per pixel, by the stone's planes as in
// reference/light_paths.h; a crystal's two waves are merged (Guy & Soler 2004, 4.2), as in beams.
// Single precision, relative to the stone's middle.
//
// Steps of a caller (native: gpu_canvas.cpp; web: WebGL2 with EXT_color_buffer_float):
// 1. Compile `vertex` with `kernel` and with `display`. Three vertices without attributes,
//    drawArrays(TRIANGLES, 0, 3), fill the viewport.
// 2. Make two RGBA32F textures of the picture's size with framebuffers: one holds the sum so far,
//    the other is drawn to; then swap them. No float blending is needed.
// 3. Bind every texture of `textures` to its unit as RGBA32F, NEAREST, CLAMP_TO_EDGE: the kernel
//    interpolates itself. The sum so far is `u_sum` on unit `k_gpu_sum_unit`.
// 4. Set `uniforms` and gpu_lights once, and again when their sources change. For each sample set
//    gpu_view; for each pass set its uniforms and gpu_eye, and draw, with `u_keep` 0 for the very
//    first draw and 1 after that.
// 5. The sum is linear sRGB times the number of samples; its fourth component is the number of
//    samples that met the stone, times the number of passes.
// 6. Show it by `display` with `u_sum`, `u_exposure` (exposure over the number of samples) and
//    `u_tone_map` (a ToneMap of image/film_look.h). Glare and sparkle are not included.
// Samples come from sample_pattern (reference/sampling.h) or elsewhere.
//
// Interactive changes touch only uniforms: camera and pupil (gpu_view); lights (gpu_lights for
// positions and sizes; `u_light_turn` turns them and the environment about the stone's middle, a
// mat3 from stone to light directions); analyser and retarder (gpu_eye); exposure; also depth,
// cut-off, index, absorption and colours of lights. The text of `kernel` changes with the stone,
// the kinds or numbers of lights, the optical class, and a scene's first analyser or polarised
// light (OpticalSetup::stokes).

#include <string>
#include <vector>

#include "render/colour/colour.h"
#include "render/reference/sampling.h"
#include "render/scene/scene.h"
#include "render/setup/optical_setup.h"

namespace culet {

/// An array of float, vec2, vec3, vec4 or, if `whole`, int, for uniform{1,2,3,4}{f,i}v. Mat3s are
/// nine numbers each, by columns.
struct GpuUniform {
    std::string name;    ///< for getUniformLocation
    int components = 1;  ///< per element; 9: a mat3
    bool whole = false;  ///< ints
    std::vector<float> values;
};

struct GpuTexture {
    std::string name;  ///< of its sampler
    int unit = 0;
    int width = 0, height = 0;
    std::vector<float> rgba;  ///< first row first
};
constexpr int k_gpu_sum_unit = 0, k_gpu_balance_unit = 1, k_gpu_length_unit = 2;

/// One draw per sample, for some of the wavelengths.
struct GpuPass {
    std::vector<GpuUniform> uniforms;
    int first = 0, count = 0;  ///< of the setup's wavelengths
};

struct GpuProgram {
    std::string vertex, kernel, display;
    std::vector<GpuUniform> uniforms;  ///< shared by all passes
    std::vector<GpuPass> passes;
    std::vector<GpuTexture> textures;
    Vec3 middle{0};  ///< of the stone: the kernel's origin
};

struct GpuOptions {
    int depth = 8;          ///< most faces of a path; depth d has d - 1 inner segments
    double cut_weight = 0;  ///< paths of less weight end
    /// Adds two targets, swapped like the sum. RGBA32F (`u_balance`), a sum: the eye's light left
    /// at the depth limit, absorbed and cut, averaged over wavelengths, and the luminance, all for
    /// the stone alone. R32F (`u_length`): faces of the longest path that carried light.
    bool balance = false;
    /// Most wavelengths per pass; fewer if many lights leave no room for uniforms. A pass of
    /// several wavelengths finds the first face once.
    int pass_wavelengths = 8;
};

/// Why the kernel cannot draw this scene, to be continued with ": say engine = ..."; empty if it
/// can.
std::string refused_by_gpu(const Scene& scene);
/// Throws InputError for such a scene.
void require_drawn_by_gpu(const Scene& scene);

/// `colours`: of the setup's wavelengths. Throws InputError for scenes that it refuses.
GpuProgram gpu_program(const Scene& scene, const OpticalSetup& setup, const WavelengthSet& colours,
                       const GpuOptions& options);

/// Uniforms of one sample: eye rays through this point of every pixel and of the pupil. The picture
/// is upright in the framebuffer (GL's first row is the lowest).
std::vector<GpuUniform> gpu_view(const Camera& camera, const SamplePoint& sample,
                                 const Vec3& middle);

/// Positions and polarisation of the lights, whose kinds and numbers must be the program's. Their
/// colours are in the passes.
std::vector<GpuUniform> gpu_lights(const Lights& lights, const Vec3& middle);

/// The eye's response at a pass's wavelengths; empty if the setup needs no Stokes parameters.
std::vector<GpuUniform> gpu_eye(const EyeOptics& optics, const OpticalSetup& setup,
                                const GpuPass& pass);

}  // namespace culet
