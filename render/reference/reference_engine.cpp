// The engine "reference": traces every pixel's rays and all their paths.

#include <fmt/format.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "render/engine/engine.h"
#include "render/reference/film.h"
#include "render/reference/pixel_shader.h"
#include "render/reference/prepared_scene.h"
#include "render/setup/scene_checks.h"
#include "render/work/listener.h"
#include "render/work/price.h"
#include "render/work/threads.h"
#include "render/work/work_meter.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

constexpr int k_tile = 16;  // pixels
constexpr int k_samples = 16, k_pupil_samples = 64, k_samples_with_objects = 64;

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

int samples_of(const Scene& scene, const OpticalSetup& setup) {
    if (scene.settings.samples > 0) return scene.settings.samples;
    if (scene.has_objects()) return k_samples_with_objects;
    return setup.on(Effects::aperture) ? k_pupil_samples : k_samples;
}

// Shades one window's pixels onto the film, tile by tile.
PixelSums shade_picture(const Scene& scene, const PreparedScene& prepared, Film& film,
                        const PixelShader& shader, const Progress& progress) {
    const Camera& camera = scene.camera;
    const long long tiles_wide = (camera.width + k_tile - 1) / k_tile;
    const long long tiles_high = (camera.height + k_tile - 1) / k_tile;
    std::vector<PixelSums> sums(static_cast<std::size_t>(tiles_wide * tiles_high));
    tbb::enumerable_thread_specific<PixelMemory> memories;
    Listener listener(progress, static_cast<double>(camera.width) * camera.height);
    WorkMeter* const meter = scene.settings.meter.get();
    const auto shade_tile = [&](long long tile) {
        std::vector<double> stokes(
            static_cast<std::size_t>(prepared.colours.size() * shader.planes()));
        PixelMemory& memory = memories.local();
        memory.goes_on = [&listener] { return listener.still_goes_on(); };
        PathWork work = work_along_paths(prepared.setup);
        PixelSums& sum = sums[static_cast<std::size_t>(tile)];
        const int x0 = static_cast<int>(tile % tiles_wide) * k_tile,
                  y0 = static_cast<int>(tile / tiles_wide) * k_tile;
        const int x1 = std::min(x0 + k_tile, camera.width);
        for (int y = y0; y < std::min(y0 + k_tile, camera.height); ++y) {
            for (int column = 0; column < x1 - x0; ++column) {
                if (!listener.goes_on()) return;
                // Alternate the direction, so that successive pixels are neighbours.
                const int x = (y - y0) % 2 == 0 ? x0 + column : x1 - 1 - column;
                const std::uint64_t number =
                    static_cast<std::uint64_t>(y) * static_cast<std::uint64_t>(camera.width) +
                    static_cast<std::uint64_t>(x);
                const PixelSums seen = shader.shade(x, y, 1.0, number, stokes.data(), memory);
                sum += seen;
                film.put(x, y, seen, stokes.data());
                if (meter == nullptr) continue;
                work.rays = static_cast<double>(seen.rays);
                work.events = static_cast<double>(seen.events);
                meter->spend(price_ns(work));
                if (meter->over()) return;
            }
        }
    };
    on_threads(scene.settings.threads, [&] {
        tbb::parallel_for(0LL, tiles_wide * tiles_high, shade_tile, tbb::simple_partitioner());
    });
    if (listener.stopped()) throw Interrupted();
    if (meter != nullptr) meter->require_not_over();
    // Sum in the order of tiles, so the result does not depend on threads.
    PixelSums whole;
    for (const PixelSums& sum : sums) whole += sum;
    return whole;
}

void fill_stats(const PixelSums& whole, const PreparedScene& prepared, RenderStats& stats) {
    stats.engine = k_reference_engine;
    stats.remainder = whole.remainder;
    stats.cut = whole.cut;
    stats.absorbed = whole.absorbed;
    stats.rays = whole.rays;
    stats.depth = whole.deepest;
    stats.worst_imbalance = whole.worst_imbalance;
    const double weight = whole.counted;
    if (weight > 0) {
        stats.remainder /= weight;
        stats.cut /= weight;
        stats.absorbed /= weight;
        stats.mean_radiance = whole.luminance / weight;
    }
    if (stats.mean_radiance > 0) {
        stats.error_bound = (stats.remainder + stats.cut) * prepared.surroundings->max_radiance() /
                            stats.mean_radiance;
        stats.standard_error = std::sqrt(whole.variance / weight) / stats.mean_radiance;
        stats.sampling_error = whole.halves_apart / whole.radiance;
    }
    if (whole.sampled > 0) {
        stats.notes.push_back(
            fmt::format("{} of {} rays split more than {} times: after that one wave was followed, "
                        "chosen by power",
                        whole.sampled, stats.rays, prepared.limits.most_splits));
    }
    stats.effects.assign(prepared.setup.effects.begin(), prepared.setup.effects.end());
    stats.wavelengths_nm = prepared.setup.wavelengths_nm;
}

class ReferenceEngine : public Engine {
public:
    std::string name() const override { return k_reference_engine; }
    std::string refuses(const Scene&, const OpticalSetup&) const override { return {}; }
    double cost_ns(const DrawingWork& work) const override {
        PathWork paths;
        paths.rays = work.pixels * work.views * work.bands;
        paths.events = paths.rays * work.faces_per_ray;
        paths.general = work.general;
        paths.polarised = work.polarised;
        paths.nodes = work.nodes;
        return price_ns(paths);
    }
    bool approaches_truth() const override { return true; }

    RenderResult draw(const Scene& whole, const Progress& progress) const override {
        const auto start = std::chrono::steady_clock::now();
        require_renderable(whole);
        Scene scene = whole;
        // A dichroscope's two windows show the same view.
        if (whole.camera.optics.two_windows) scene.camera.width /= 2;
        const PreparedScene prepared(scene);
        const PixelShader shader(scene, prepared, samples_of(scene, prepared.setup));
        Film film(scene, scene.camera, prepared.setup, prepared.colours, shader.planes());
        RenderResult result;
        result.stats.notes = notes_on_drawing(scene);
        result.stats.seconds_setup = seconds_since(start);
        const auto shading = std::chrono::steady_clock::now();
        const PixelSums sums = shade_picture(scene, prepared, film, shader, progress);
        result.picture = film.take(sums.variance > 0);
        fill_stats(sums, prepared, result.stats);
        result.stats.seconds_shade = seconds_since(shading);
        return result;
    }
};

}  // namespace

const Engine& reference_engine() {
    static const ReferenceEngine engine;
    return engine;
}

}  // namespace culet
