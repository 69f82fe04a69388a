#include "render/render.h"

#include <fmt/format.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "render/reference/film.h"
#include "render/reference/light_field.h"
#include "render/reference/pilot.h"
#include "render/reference/pixel_shader.h"
#include "render/reference/reference.h"
#include "render/setup/scene_checks.h"
#include "render/work/listener.h"
#include "render/work/price.h"
#include "render/work/threads.h"
#include "render/work/work_meter.h"
#include "stone/errors.h"

namespace culet {

namespace {

constexpr int k_tile = 16;  // pixels
constexpr int k_samples = 16, k_pupil_samples = 64;

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

RenderResult render_with_reference(const Scene& whole, const Progress& progress) {
    const auto start = std::chrono::steady_clock::now();
    require_renderable(whole);
    // The two windows of a dichroscope are one view, seen twice.
    const int windows = whole.camera.optics.two_windows ? 2 : 1;
    Scene scene = whole;
    scene.camera.width /= windows;
    const OpticalSetup setup = setup_for_tolerance(scene);
    const WavelengthSet colours(setup.wavelengths_nm);
    const LightField lights(scene.lights, colours);
    const Camera& camera = scene.camera;
    const RenderSettings& settings = scene.settings;

    const PathLimits limits = limits_for(scene, setup, lights, colours);
    const int samples = settings.samples > 0          ? settings.samples
                        : setup.on(Effects::aperture) ? k_pupil_samples
                                                      : k_samples;
    const PixelShader shader(scene, setup, lights, colours, limits, samples);
    Film film(scene, camera, setup, colours, shader.planes());
    RenderResult result;
    result.stats.seconds_setup = seconds_since(start);

    const auto shading = std::chrono::steady_clock::now();
    const long long tiles_wide = (camera.width + k_tile - 1) / k_tile;
    const long long tiles_high = (camera.height + k_tile - 1) / k_tile;
    std::vector<PixelSums> sums(static_cast<std::size_t>(tiles_wide * tiles_high));
    tbb::enumerable_thread_specific<PixelMemory> memories;
    // At every pixel: one may take seconds.
    Listener listener(progress, static_cast<double>(camera.width) * camera.height);
    WorkMeter* const meter = settings.meter.get();
    PathWork of_a_ray;
    of_a_ray.general = setup.general;
    of_a_ray.polarised = setup.polarised;
    of_a_ray.nodes = setup.bands.front().count;
    const auto shade_tile = [&](long long tile) {
        std::vector<double> stokes(static_cast<std::size_t>(colours.size() * shader.planes()));
        PixelMemory& memory = memories.local();
        PathWork work = of_a_ray;
        PixelSums& sum = sums[static_cast<std::size_t>(tile)];
        const int x0 = static_cast<int>(tile % tiles_wide) * k_tile,
                  y0 = static_cast<int>(tile / tiles_wide) * k_tile;
        const int x1 = std::min(x0 + k_tile, camera.width);
        for (int y = y0; y < std::min(y0 + k_tile, camera.height); ++y) {
            for (int column = 0; column < x1 - x0; ++column) {
                if (!listener.goes_on()) return;
                // To and fro, so that each pixel is next to the one before.
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
    on_threads(settings.threads, [&] {
        tbb::parallel_for(0LL, tiles_wide * tiles_high, shade_tile, tbb::simple_partitioner());
    });
    if (listener.stopped()) throw Interrupted();
    if (meter != nullptr) meter->require_not_over();

    // Sums in the order of the tiles: the same bytes whatever the threads did.
    RenderStats& stats = result.stats;
    PixelSums whole_picture;
    for (const PixelSums& sum : sums) whole_picture += sum;
    const double weight = whole_picture.hit, variance = whole_picture.variance;
    stats.remainder = whole_picture.remainder;
    stats.cut = whole_picture.cut;
    stats.absorbed = whole_picture.absorbed;
    stats.rays = whole_picture.rays;
    stats.depth = whole_picture.deepest;
    stats.worst_imbalance = whole_picture.worst_imbalance;
    if (weight > 0) {
        stats.remainder /= weight;
        stats.cut /= weight;
        stats.absorbed /= weight;
        stats.mean_radiance = whole_picture.luminance / weight;
    }
    if (stats.mean_radiance > 0) {
        stats.error_bound =
            (stats.remainder + stats.cut) * lights.max_radiance() / stats.mean_radiance;
        stats.standard_error = std::sqrt(variance / weight) / stats.mean_radiance;
        stats.sampling_error = whole_picture.halves_apart / whole_picture.radiance;
    }
    result.picture = film.take(variance > 0);
    stats.notes = notes_on_drawing(scene);
    if (whole_picture.sampled > 0) {
        stats.notes.push_back(
            fmt::format("the trees of {} of {} rays grew over {} splits: from there on one wave "
                        "was followed, chosen by power",
                        whole_picture.sampled, stats.rays, limits.most_splits));
    }
    stats.effects.assign(setup.effects.begin(), setup.effects.end());
    stats.wavelengths_nm = setup.wavelengths_nm;
    stats.seconds_shade = seconds_since(shading);
    return result;
}

}  // namespace culet
