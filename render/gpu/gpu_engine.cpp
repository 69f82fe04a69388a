// The engine "gpu": runs the kernel on a windowless GL driver.

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "render/engine/engine.h"
#include "render/gpu/gpu_canvas.h"
#include "render/reference/film.h"
#include "render/reference/prepared_scene.h"
#include "render/setup/scene_checks.h"
#include "render/work/listener.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

constexpr int k_samples = 16, k_pupil_samples = 64;
// Wavelengths per pass if each is to have its own channel.
constexpr int k_channels = 3;
// Nanoseconds, measured on Mesa's llvmpipe (docs/gpu.md); a graphics card takes less.
constexpr double k_ns_per_face = 76, k_ns_polarised = 7, k_ns_merged = 36, k_ns_to_compile = 8e8;

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// Sums over the stone's pixels.
struct Totals {
    double remainder = 0, absorbed = 0, cut = 0, luminance = 0, hits = 0;
    int longest = 0;
};

struct Drawing {
    Drawing(const Scene& whole, const PreparedScene& made_ready, const Progress& progress)
        : scene(whole), prepared(made_ready), asked(progress) {
        const bool pupil = prepared.setup.on(Effects::aperture);
        const int samples = scene.settings.samples > 0 ? scene.settings.samples
                            : pupil                    ? k_pupil_samples
                                                       : k_samples;
        pattern =
            sample_pattern(samples, pupil, scene.settings.filter, scene.settings.filter_radius);
    }

    const Scene& scene;
    const PreparedScene& prepared;
    const Progress& asked;
    std::vector<SamplePoint> pattern;
    GlContext context;
    Totals totals;

    GpuProgram program() const {
        GpuOptions options;
        options.depth = prepared.limits.depth;
        options.cut_weight = prepared.limits.cut_weight;
        options.balance = true;
        if (scene.settings.spectral) options.pass_wavelengths = k_channels;
        return gpu_program(scene, prepared.setup, prepared.colours, options);
    }

    // Draws all samples, with the uniforms of each pass.
    void draw(const GpuProgram& program, GpuCanvas& canvas,
              const std::vector<std::vector<GpuUniform>>& passes, Listener& listener) const {
        canvas.start_anew();
        for (const SamplePoint& sample : pattern) {
            canvas.set(gpu_view(scene.camera, sample, program.middle));
            for (const std::vector<GpuUniform>& pass : passes) {
                canvas.set(pass);
                if (!canvas.draw([&] { return listener.goes_on(); })) throw Interrupted();
            }
        }
    }

    void add_balance(const GpuCanvas& canvas, double passes) {
        const std::vector<float> sum = canvas.read(0), balance = canvas.read(1),
                                 length = canvas.read(2);
        const double samples = static_cast<double>(pattern.size());
        for (std::size_t i = 0; i < sum.size(); i += 4) {
            totals.hits += static_cast<double>(sum[i + 3]) / samples / passes;
            totals.remainder += static_cast<double>(balance[i]) / samples;
            totals.absorbed += static_cast<double>(balance[i + 1]) / samples;
            totals.cut += static_cast<double>(balance[i + 2]) / samples;
            totals.luminance += static_cast<double>(balance[i + 3]) / samples;
            totals.longest = std::max(totals.longest, static_cast<int>(length[i]));
        }
    }

    Picture picture();
    Picture spectral_picture();
};

Picture Drawing::picture() {
    const GpuProgram made = program();
    GpuCanvas canvas(context, made, scene.camera.width, scene.camera.height, true);
    canvas.set(gpu_lights(scene.lights, made.middle));
    std::vector<std::vector<GpuUniform>> passes;
    for (const GpuPass& pass : made.passes) {
        std::vector<GpuUniform> uniforms = pass.uniforms;
        const std::vector<GpuUniform> eye = gpu_eye(scene.camera.optics, prepared.setup, pass);
        uniforms.insert(uniforms.end(), eye.begin(), eye.end());
        passes.push_back(std::move(uniforms));
    }
    const double count = static_cast<double>(passes.size());
    Listener listener(asked, count * static_cast<double>(pattern.size()) * canvas.parts());
    draw(made, canvas, passes, listener);
    Picture picture;
    picture.width = scene.camera.width;
    picture.height = scene.camera.height;
    const std::vector<float> sum = canvas.read(0);
    const double share = 1 / static_cast<double>(pattern.size());
    for (std::size_t i = 0; i < sum.size(); i += 4) {
        for (std::size_t c = 0; c < 3; ++c)
            picture.rgb.push_back(static_cast<float>(share * static_cast<double>(sum[i + c])));
        picture.coverage.push_back(
            static_cast<float>(share / count * static_cast<double>(sum[i + 3])));
    }
    add_balance(canvas, count);
    return picture;
}

// Uniforms of a pass that shows each wavelength in its own channel; with `stokes` parameter k.
std::vector<GpuUniform> one_a_channel(const GpuPass& pass, bool stokes, int k) {
    std::vector<GpuUniform> uniforms = pass.uniforms;
    for (GpuUniform& uniform : uniforms) {
        if (uniform.name != "u_colour") continue;
        std::fill(uniform.values.begin(), uniform.values.end(), 0.0f);
        for (std::size_t i = 0; i < static_cast<std::size_t>(pass.count); ++i)
            uniform.values[3 * i + i] = 1;
    }
    GpuUniform row{"u_response", 4, false, {}};
    for (int i = 0; i < pass.count; ++i) {
        for (int j = 0; j < 4; ++j) row.values.push_back(j == k ? 1.0f : 0.0f);
    }
    if (stokes) uniforms.push_back(row);
    return uniforms;
}

// Draws wavelength by wavelength, with all four Stokes parameters if needed.
Picture Drawing::spectral_picture() {
    const GpuProgram made = program();
    GpuCanvas canvas(context, made, scene.camera.width, scene.camera.height, true);
    canvas.set(gpu_lights(scene.lights, made.middle));
    const OpticalSetup& setup = prepared.setup;
    const int planes = setup.stokes ? 4 : 1;
    const std::size_t nodes = setup.wavelengths_nm.size(),
                      values = nodes * static_cast<std::size_t>(planes);
    const std::size_t pixels = static_cast<std::size_t>(scene.camera.width) *
                               static_cast<std::size_t>(scene.camera.height);
    std::vector<float> stokes(pixels * values), covered(pixels);
    Listener listener(asked, static_cast<double>(made.passes.size()) * planes *
                                 static_cast<double>(pattern.size()) * canvas.parts());
    const double share = 1 / static_cast<double>(pattern.size());
    for (int k = 0; k < planes; ++k) {
        for (const GpuPass& pass : made.passes) {
            draw(made, canvas, {one_a_channel(pass, setup.stokes, k)}, listener);
            if (k == 0) add_balance(canvas, 1);
            const std::vector<float> sum = canvas.read(0);
            for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
                for (std::size_t i = 0; i < static_cast<std::size_t>(pass.count); ++i) {
                    stokes[pixel * values + static_cast<std::size_t>(k) * nodes +
                           static_cast<std::size_t>(pass.first) + i] =
                        static_cast<float>(share * static_cast<double>(sum[4 * pixel + i]));
                }
                covered[pixel] = static_cast<float>(share) * sum[4 * pixel + 3];
            }
        }
    }
    totals.hits /= static_cast<double>(made.passes.size());
    Film film(scene, scene.camera, setup, prepared.colours, planes);
    std::vector<double> estimates(values);
    totals.luminance = 0;
    for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
        std::copy_n(stokes.begin() + static_cast<std::ptrdiff_t>(pixel * values), values,
                    estimates.begin());
        PixelSums sums;
        sums.hit = static_cast<double>(covered[pixel]);
        const std::size_t width = static_cast<std::size_t>(scene.camera.width);
        film.put(static_cast<int>(pixel % width), static_cast<int>(pixel / width), sums,
                 estimates.data());
    }
    Picture picture = film.take(false);
    // From pixels that the stone fills completely.
    double whole = 0;
    for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
        if (covered[pixel] < 1) continue;
        whole += 1;
        totals.luminance += luminance(picture.rgb.data() + 3 * pixel);
    }
    if (whole > 0) totals.luminance *= totals.hits / whole;
    return picture;
}

void fill_stats(const Drawing& drawing, RenderStats& stats) {
    const Totals& totals = drawing.totals;
    const PreparedScene& prepared = drawing.prepared;
    stats.engine = k_gpu_engine;
    stats.depth = totals.longest;
    stats.effects.assign(prepared.setup.effects.begin(), prepared.setup.effects.end());
    stats.wavelengths_nm = prepared.setup.wavelengths_nm;
    stats.rays = std::llround(totals.hits * static_cast<double>(drawing.pattern.size()) *
                              static_cast<double>(prepared.setup.bands.size()));
    if (totals.hits > 0) {
        stats.remainder = totals.remainder / totals.hits;
        stats.absorbed = totals.absorbed / totals.hits;
        stats.cut = totals.cut / totals.hits;
        stats.mean_radiance = totals.luminance / totals.hits;
    }
    if (stats.mean_radiance > 0) {
        stats.error_bound = (stats.remainder + stats.cut) * prepared.surroundings->max_radiance() /
                            stats.mean_radiance;
    }
    if (prepared.setup.splits) {
        stats.effects[static_cast<std::size_t>(Effects::birefringence)].why +=
            "; the two waves merged: a GPU follows one way";
        stats.error_bound = std::numeric_limits<double>::quiet_NaN();
        stats.notes.emplace_back(
            "a crystal's two waves share one path here (docs/gpu.md), with an error that is not "
            "known; engine = \"reference\" follows both");
    }
    stats.notes.push_back("drawn by " + drawing.context.renderer());
}

class GpuEngine : public Engine {
public:
    std::string name() const override { return k_gpu_engine; }
    std::string refuses(const Scene& scene, const OpticalSetup&) const override {
        return refused_by_gpu(scene);
    }
    double cost_ns(const DrawingWork& work) const override {
        const double a_face =
            k_ns_per_face + (work.polarised ? k_ns_polarised : 0) + (work.splits ? k_ns_merged : 0);
        return k_ns_to_compile +
               a_face * work.pixels * work.views * work.bands * work.faces_per_ray;
    }
    // A crystal's waves stay merged.
    bool approaches_truth() const override { return false; }

    RenderResult draw(const Scene& scene, const Progress& progress) const override {
        const auto start = std::chrono::steady_clock::now();
        require_renderable(scene);
        require_drawn_by_gpu(scene);
        const PreparedScene prepared(scene);
        RenderResult result;
        Drawing drawing(scene, prepared, progress);
        result.stats.seconds_setup = seconds_since(start);
        const auto shading = std::chrono::steady_clock::now();
        result.picture = scene.settings.spectral ? drawing.spectral_picture() : drawing.picture();
        result.stats.notes = notes_on_drawing(scene);
        fill_stats(drawing, result.stats);
        result.stats.seconds_shade = seconds_since(shading);
        return result;
    }
};

}  // namespace

const Engine& gpu_engine() {
    static const GpuEngine engine;
    return engine;
}

}  // namespace culet
