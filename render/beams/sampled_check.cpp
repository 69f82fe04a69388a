#include "render/beams/sampled_check.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "render/optics/eye_optics.h"
#include "render/reference/pixel_shader.h"
#include "render/work/listener.h"
#include "render/work/threads.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

// Checked pixels across the picture, and reference rays in each. The noise of these rays counts as
// error of the beams, so it can only raise the bound.
constexpr int k_checked_across = 64, k_check_samples = 16;
constexpr double k_standard_errors = 3;

// Pixels on a grid over the picture, or `wanted` pixels on the stone, jittered by the golden ratio.
std::vector<std::size_t> pixels_to_check(const Picture& picture, int wanted, double filled) {
    const double area =
        wanted > 0 ? filled
                   : std::pow(static_cast<double>(std::max(picture.width, picture.height)), 2);
    const double count = wanted > 0 ? wanted : k_checked_across * k_checked_across;
    const double step = std::max(1.0, std::sqrt(area / count));
    std::vector<std::size_t> pixels;
    int number = 0;
    for (double y = 0; y < picture.height; y += step) {
        for (double x = 0; x < picture.width; x += step, ++number) {
            const int px = static_cast<int>(x + step * std::fmod(number * 0.6180339887498949, 1.0)),
                      py = static_cast<int>(y + step * std::fmod(number * 0.7548776662466927, 1.0));
            if (px >= picture.width || py >= picture.height) continue;
            const std::size_t pixel =
                static_cast<std::size_t>(py) * static_cast<std::size_t>(picture.width) +
                static_cast<std::size_t>(px);
            if (picture.coverage[pixel] > 0) pixels.push_back(pixel);
        }
    }
    return pixels;
}

}  // namespace

SampledCheck check_against_reference(const Scene& scene, const PreparedScene& prepared,
                                     const Picture& picture, double filled, double mean_radiance,
                                     const Progress& progress) {
    const RenderSettings& settings = scene.settings;
    const bool single = settings.samples == 1 && scene.camera.aperture_radius == 0;
    const int samples = single                         ? 1
                        : settings.checked_samples > 0 ? settings.checked_samples
                                                       : k_check_samples;
    const PixelShader shader(scene, prepared, samples);
    const std::vector<std::size_t> pixels =
        pixels_to_check(picture, settings.checked_pixels, filled);
    const std::vector<Stokes> behind =
        responses(scene.camera.optics, prepared.setup.wavelengths_nm);
    std::vector<double> errors(pixels.size());
    Listener listener(progress);
    on_threads(settings.threads, [&] {
        tbb::parallel_for(std::size_t{0}, pixels.size(), [&](std::size_t i) {
            PixelMemory memory;
            memory.goes_on = [&listener] { return listener.still_goes_on(); };
            std::vector<double> stokes(
                static_cast<std::size_t>(prepared.colours.size() * shader.planes()));
            const int x = static_cast<int>(pixels[i] % static_cast<std::size_t>(picture.width)),
                      y = static_cast<int>(pixels[i] / static_cast<std::size_t>(picture.width));
            shader.shade(x, y, 1, pixels[i], stokes.data(), memory);
            look_through(behind, shader.planes(), stokes.data());
            const Rgb exact = prepared.colours.rgb_of(stokes.data());
            const float* seen = picture.rgb.data() + 3 * pixels[i];
            errors[i] = std::abs(luminance(exact) - luminance({static_cast<double>(seen[0]),
                                                               static_cast<double>(seen[1]),
                                                               static_cast<double>(seen[2])}));
        });
    });
    if (listener.stopped()) throw Interrupted();
    double sum = 0, squares = 0;
    for (double error : errors) {
        // Non-finite pixels count with the largest possible error.
        if (!std::isfinite(error)) error = prepared.surroundings->max_radiance();
        sum += error;
        squares += error * error;
    }
    SampledCheck found;
    found.pixels = static_cast<int>(errors.size());
    if (!errors.empty() && mean_radiance > 0) {
        const double count = static_cast<double>(errors.size()), mean = sum / count;
        const double spread = std::sqrt(std::max(0.0, squares / count - mean * mean) / count);
        found.error = (mean + k_standard_errors * spread) / mean_radiance;
    }
    return found;
}

}  // namespace culet
