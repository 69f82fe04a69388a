#pragma once
// A convex stone as a program for a GPU: GLSL ES 3.00 for OpenGL ES 3 and WebGL2. No GL in here.
//
// What the kernel draws: light paths of one eye ray a pixel, by the stone's planes, as
// reference/light_paths.h has them; a crystal's two waves merged (Guy & Soler 2004, 4.2), as beams
// merge them. Single precision, about the stone's middle.
//
// How a caller drives it (natively: gpu_canvas.cpp; a page: WebGL2 with EXT_color_buffer_float):
//   1. Compile `vertex` with `kernel`, and `vertex` with `display`. Nothing is bound to draw: three
//      vertices without attributes, drawArrays(TRIANGLES, 0, 3), fill the viewport.
//   2. Two RGBA32F textures of the picture's size, each with a framebuffer: one holds the sum so
//      far, the other is drawn to; then they change places. No float blending is needed.
//   3. Every texture of `textures` goes to its unit as RGBA32F, NEAREST, CLAMP_TO_EDGE: the kernel
//      interpolates by itself. The sum so far is `u_sum` on unit `k_gpu_sum_unit`.
//   4. Once, or when what they are made of changes: `uniforms` and gpu_lights. For every sample
//      the uniforms of gpu_view; for every pass of `passes` its uniforms and those of gpu_eye; draw
//      with `u_keep` 0 for the first of all draws and 1 after that.
//   5. The sum holds linear sRGB times the number of samples; its fourth number is how many samples
//      met the stone, times the number of passes.
//   6. To show it: `display` with `u_sum`, `u_exposure` (exposure over the number of samples) and
//      `u_tone_map`, a ToneMap of image/film_look.h as a number. Glare and sparkle are not in it.
// Samples: as sample_pattern of reference/sampling.h gives them, or any.
//
// What a person changes live touches uniforms alone: camera and pupil (gpu_view), lights
// (gpu_lights for their places and sizes, `u_light_turn` to turn all of them and the environment
// about the stone's middle, a mat3 that takes stone directions to those of the lights), analyser
// and retarder (gpu_eye), exposure. Depth, cut, index, absorption and colours of lights are
// uniforms too: `kernel` is then the same text and need not be compiled again. Another text comes
// from another stone, other kinds or numbers of lights, another optical class, and the first
// analyser or polarised light of a scene (OpticalSetup::stokes).

#include <string>
#include <vector>

#include "render/colour/colour.h"
#include "render/reference/sampling.h"
#include "render/scene/scene.h"
#include "render/setup/optical_setup.h"

namespace culet {

/// An array of float, vec2, vec3, vec4 or, `whole`, int: uniform{1,2,3,4}{f,i}v. Arrays of mat3 are
/// nine numbers each, by columns.
struct GpuUniform {
    std::string name;    ///< as getUniformLocation wants it
    int components = 1;  ///< of each element; 9: a mat3
    bool whole = false;  ///< ints
    std::vector<float> values;
};

struct GpuTexture {
    std::string name;  ///< of its sampler
    int unit = 0;
    int width = 0, height = 0;
    std::vector<float> rgba;  ///< the first row first
};
constexpr int k_gpu_sum_unit = 0, k_gpu_balance_unit = 1, k_gpu_length_unit = 2;

/// One draw of each sample: some of the wavelengths.
struct GpuPass {
    std::vector<GpuUniform> uniforms;
    int first = 0, count = 0;  ///< of the setup's wavelengths
};

struct GpuProgram {
    std::string vertex, kernel, display;
    std::vector<GpuUniform> uniforms;  ///< that every pass has
    std::vector<GpuPass> passes;
    std::vector<GpuTexture> textures;
    Vec3 middle{0};  ///< of the stone, the kernel's origin
};

struct GpuOptions {
    int depth = 8;          ///< faces of a path at most; depth d has d - 1 inner segments
    double cut_weight = 0;  ///< a path of less weight is not followed
    /// Two more targets and what they held before, as for the sum: RGBA32F (`u_balance`), what of
    /// the eye's light was left at the depth limit, absorbed and cut, meant over all wavelengths,
    /// and the luminance, all of the stone alone and summed; R32F (`u_length`), the faces of the
    /// longest path that brought light.
    bool balance = false;
    /// Wavelengths of one pass at most; fewer where many lights leave no room for uniforms. A pass
    /// of several finds the first face once.
    int pass_wavelengths = 8;
};

/// Why the kernel cannot draw this scene, in words that go on with ": say engine = ..."; empty: it
/// can.
std::string refused_by_gpu(const Scene& scene);
/// Throws InputError where it cannot.
void require_drawn_by_gpu(const Scene& scene);

/// `colours`: of the setup's wavelengths. Throws InputError for what is refused.
GpuProgram gpu_program(const Scene& scene, const OpticalSetup& setup, const WavelengthSet& colours,
                       const GpuOptions& options);

/// Of one sample: the eye rays through all pixels at that point of each and of the pupil. The
/// picture stands upright in the framebuffer (GL's first row is the lowest).
std::vector<GpuUniform> gpu_view(const Camera& camera, const SamplePoint& sample,
                                 const Vec3& middle);

/// Where the lights stand and what polarises them; of as many of each kind as the program was made
/// for. Their colours are in the passes.
std::vector<GpuUniform> gpu_lights(const Lights& lights, const Vec3& middle);

/// What the eye responds to at a pass's wavelengths; nothing where the setup has no need of Stokes
/// parameters.
std::vector<GpuUniform> gpu_eye(const EyeOptics& optics, const OpticalSetup& setup,
                                const GpuPass& pass);

}  // namespace culet
