#include "render/render.h"

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <mutex>

#include "render/eye_optics.h"
#include "render/pixel_shader.h"
#include "render/scene_checks.h"
#include "stone/errors.h"

namespace culet {

namespace {

constexpr int k_deepest = 1000;     // by tolerance; what is left then is reported as remainder
constexpr int k_tile = 16;          // pixels
constexpr int k_pilot_pixels = 24;  // along the picture's longer side
// Crystals: a path splits in two at every hit while it carries more than this.
constexpr double k_split_weight = 0.02;
constexpr double k_gambled_weight = 1e-3;
constexpr int k_samples = 16, k_pupil_samples = 64;

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// Calls visit(x, y, size) for an even choice of pixels.
template <class Visit>
void each_pilot_pixel(const Camera& camera, int along, Visit&& visit) {
    const double step =
        std::max(1.0, static_cast<double>(std::max(camera.width, camera.height)) / along);
    for (double y = 0; y < camera.height; y += step) {
        for (double x = 0; x < camera.width; x += step) visit(x, y, step);
    }
}

// Mean luminance of the stone at low resolution: what a tolerance is relative to.
double pilot_mean(const Scene& scene, const Plan& plan, const LightField& lights,
                  const WavelengthSet& colours, PathLimits limits) {
    limits.depth = 16;
    limits.cut_weight = 1e-3;
    limits.split_weight = 1;
    limits.roulette = false;
    const PixelShader shader(scene, plan, lights, colours, limits, 1);
    std::vector<double> stokes(plan.wavelengths_nm.size() *
                               static_cast<std::size_t>(shader.planes()));
    double sum = 0, hits = 0;
    each_pilot_pixel(scene.camera, k_pilot_pixels, [&](double x, double y, double size) {
        const PixelSums pixel = shader.shade(x, y, size, 0, stokes.data());
        hits += pixel.hit;
        sum += pixel.luminance;
    });
    return hits > 0 ? sum / hits : 0;
}

// The fewest wavelengths whose colours differ from those of the finest set by less than the
// tolerance, root mean square over a few pixels and relative to their mean: seen on paths of a few
// faces, which are where the light is.
constexpr int k_spectral_pixels = 10, k_spectral_samples = 16;
constexpr int k_spectral_depth = 12, k_spectral_crystal_depth = 6;  // of trees that double

Plan plan_for_tolerance(const Scene& scene) {
    Plan plan = make_plan(scene);
    if (!(scene.settings.tolerance > 0) || !chose_spectrum(scene, plan)) return plan;
    const Plan finest = make_plan(scene, k_node_counts.back());
    const WavelengthSet colours(finest.wavelengths_nm);
    const LightField lights(scene.lights, colours);
    PathLimits limits;
    limits.depth = plan.splits ? k_spectral_crystal_depth : k_spectral_depth;
    limits.cut_weight = 1e-4;
    limits.split_weight = 0;
    limits.polarised = finest.polarised;
    const PixelShader shader(scene, finest, lights, colours, limits, k_spectral_samples);
    const std::size_t nodes = finest.wavelengths_nm.size();
    std::vector<double> stokes(nodes * static_cast<std::size_t>(shader.planes()));
    std::vector<std::vector<double>> spectra;
    each_pilot_pixel(scene.camera, k_spectral_pixels, [&](double x, double y, double) {
        if (shader.shade(x, y, 1, 0, stokes.data()).hit > 0)
            spectra.emplace_back(stokes.begin(), stokes.begin() + static_cast<long>(nodes));
    });
    for (int count : k_node_counts) {
        const Plan coarse = make_plan(scene, count);
        const std::size_t every = (nodes - 1) / (coarse.wavelengths_nm.size() - 1);
        const WavelengthSet few(coarse.wavelengths_nm);
        double squares = 0, mean = 0;
        std::vector<double> chosen(coarse.wavelengths_nm.size());
        for (const std::vector<double>& spectrum : spectra) {
            for (std::size_t i = 0; i < chosen.size(); ++i) chosen[i] = spectrum[i * every];
            const Rgb fine = colours.rgb_of(spectrum.data()), rough = few.rgb_of(chosen.data());
            for (int c = 0; c < 3; ++c) {
                squares += (fine[c] - rough[c]) * (fine[c] - rough[c]);
                mean += fine[c];
            }
        }
        const double values = 3 * static_cast<double>(spectra.size());
        if (std::sqrt(squares * values) <= scene.settings.tolerance * mean) return coarse;
    }
    return finest;
}

}  // namespace

RenderResult render(const Scene& whole, const Progress& progress) {
    const auto start = std::chrono::steady_clock::now();
    require_renderable(whole);
    // The two windows of a dichroscope are one view, seen twice.
    const int windows = whole.camera.optics.two_windows ? 2 : 1;
    Scene scene = whole;
    scene.camera.width /= windows;
    const Plan plan = plan_for_tolerance(scene);
    const WavelengthSet colours(plan.wavelengths_nm);
    const LightField lights(scene.lights, colours);
    const Camera& camera = scene.camera;
    const RenderSettings& settings = scene.settings;

    PathLimits limits;
    limits.seed = settings.seed;
    limits.polarised = plan.polarised;
    limits.depth = settings.depth > 0 ? settings.depth : k_deepest;
    if (settings.tolerance > 0) {
        const double mean = pilot_mean(scene, plan, lights, colours, limits);
        const double brightest = lights.max_radiance();
        // What is cut sees at most the brightest light. Half of what that allows, because the
        // pilot's mean is itself a few per cent off.
        limits.cut_weight = brightest > 0 && mean > 0 ? 0.5 * settings.tolerance * mean / brightest
                                                      : settings.tolerance;
        limits.cut_weight = std::min(limits.cut_weight, settings.tolerance);
        limits.split_weight = std::max(k_split_weight, limits.cut_weight);
        // Trees that branch gamble instead of cutting: that costs no accuracy but noise, which a
        // light of great radiance must not make as dear as it makes cutting.
        limits.roulette = plan.splits || !scene.stone.convex;
        if (limits.roulette) limits.cut_weight = std::max(limits.cut_weight, k_gambled_weight);
    }

    RenderResult result;
    Picture& picture = result.picture;
    picture.width = windows * camera.width;
    picture.height = camera.height;
    picture.rgb.resize(3 * picture.pixels());
    picture.coverage.resize(picture.pixels());
    const int nodes = colours.size();
    if (settings.spectral) {
        picture.wavelengths_nm = plan.wavelengths_nm;
        picture.spectral.assign(nodes, std::vector<float>(picture.pixels()));
    }
    const int samples = settings.samples > 0         ? settings.samples
                        : plan.on(Effects::aperture) ? k_pupil_samples
                                                     : k_samples;
    const PixelShader shader(scene, plan, lights, colours, limits, samples);
    if (settings.spectral && shader.planes() == 4 && windows == 1) {
        for (auto& planes : picture.polarised)
            planes.assign(nodes, std::vector<float>(picture.pixels()));
    }
    // Behind the eye's optics: radiance at each node, of one window.
    std::vector<Stokes> rows;
    for (int window = 0; window < windows; ++window) {
        for (double nm : plan.wavelengths_nm) rows.push_back(response(camera.optics, nm, window));
    }
    const std::size_t seen_pixels =
        static_cast<std::size_t>(camera.width) * static_cast<std::size_t>(camera.height);
    std::vector<PixelSums> sums(seen_pixels);
    result.stats.seconds_setup = seconds_since(start);

    const auto shading = std::chrono::steady_clock::now();
    const long long tiles_wide = (camera.width + k_tile - 1) / k_tile;
    const long long tiles_high = (camera.height + k_tile - 1) / k_tile;
    std::atomic<bool> stop{false};
    std::mutex reporting;
    long long done = 0;
    const auto shade_tile = [&](long long tile) {
        if (stop.load(std::memory_order_relaxed)) return;
        std::vector<double> stokes(static_cast<std::size_t>(nodes * shader.planes()));
        std::vector<double> radiance(nodes);
        const int x0 = static_cast<int>(tile % tiles_wide) * k_tile,
                  y0 = static_cast<int>(tile / tiles_wide) * k_tile;
        for (int y = y0; y < std::min(y0 + k_tile, camera.height); ++y) {
            for (int x = x0; x < std::min(x0 + k_tile, camera.width); ++x) {
                const std::size_t number =
                    static_cast<std::size_t>(y) * static_cast<std::size_t>(camera.width) +
                    static_cast<std::size_t>(x);
                sums[number] = shader.shade(x, y, 1.0, number, stokes.data());
                for (int window = 0; window < windows; ++window) {
                    const std::size_t pixel =
                        static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
                        static_cast<std::size_t>(x + window * camera.width);
                    for (int i = 0; i < nodes; ++i) {
                        radiance[i] = 0;
                        for (int k = 0; k < shader.planes(); ++k)
                            radiance[i] += rows[window * nodes + i][k] * stokes[k * nodes + i];
                    }
                    const Rgb rgb = colours.rgb_of(radiance.data());
                    for (int c = 0; c < 3; ++c)
                        picture.rgb[3 * pixel + c] = static_cast<float>(rgb[c]);
                    picture.coverage[pixel] = static_cast<float>(sums[number].hit);
                    if (!settings.spectral) continue;
                    for (int i = 0; i < nodes; ++i) {
                        picture.spectral[i][pixel] = static_cast<float>(radiance[i]);
                        for (int k = 0; k < 3 && !picture.polarised[k].empty(); ++k)
                            picture.polarised[k][i][pixel] =
                                static_cast<float>(stokes[(k + 1) * nodes + i]);
                    }
                }
            }
        }
        const std::lock_guard<std::mutex> lock(reporting);
        ++done;
        if (progress &&
            !progress(static_cast<double>(done) / static_cast<double>(tiles_wide * tiles_high))) {
            stop.store(true, std::memory_order_relaxed);
        }
    };
    // More threads than processors are allowed when asked for, and without TBB's warning on stderr.
    const int most = static_cast<int>(
        tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
    const tbb::global_control allow(
        tbb::global_control::max_allowed_parallelism,
        static_cast<std::size_t>(std::max({most, settings.threads, 1})));
    tbb::task_arena arena(settings.threads > 0 ? settings.threads : tbb::task_arena::automatic);
    arena.execute([&] {
        tbb::parallel_for(0LL, tiles_wide * tiles_high, shade_tile, tbb::simple_partitioner());
    });
    if (stop.load()) throw Interrupted();

    // Sums in the order of the pixels: the same bytes whatever the threads did.
    RenderStats& stats = result.stats;
    double weight = 0, seen = 0, variance = 0;
    long long sampled = 0;
    for (std::size_t i = 0; i < sums.size(); ++i) {
        weight += sums[i].hit;
        stats.remainder += sums[i].remainder;
        stats.cut += sums[i].cut;
        stats.absorbed += sums[i].absorbed;
        stats.rays += sums[i].rays;
        sampled += sums[i].sampled;
        variance += sums[i].variance;
        stats.depth = std::max(stats.depth, sums[i].deepest);
        stats.worst_imbalance = std::max(stats.worst_imbalance, sums[i].worst_imbalance);
        seen += sums[i].luminance;
    }
    if (weight > 0) {
        stats.remainder /= weight;
        stats.cut /= weight;
        stats.absorbed /= weight;
        stats.mean_radiance = seen / weight;
    }
    if (stats.mean_radiance > 0) {
        stats.error_bound =
            (stats.remainder + stats.cut) * lights.max_radiance() / stats.mean_radiance;
        stats.standard_error = std::sqrt(variance / weight) / stats.mean_radiance;
    }
    if (variance > 0) {
        picture.standard_error.resize(picture.pixels());
        for (std::size_t pixel = 0; pixel < picture.pixels(); ++pixel) {
            const std::size_t x = pixel % static_cast<std::size_t>(picture.width),
                              y = pixel / static_cast<std::size_t>(picture.width),
                              width = static_cast<std::size_t>(camera.width);
            picture.standard_error[pixel] =
                static_cast<float>(std::sqrt(sums[y * width + x % width].variance));
        }
    }
    stats.notes = notes_on_drawing(scene);
    if (sampled > 0) {
        stats.notes.push_back(
            fmt::format("the trees of {} of {} rays grew over {} splits: from there on one wave "
                        "was followed, chosen by power",
                        sampled, stats.rays, limits.most_splits));
    }
    if (settings.tolerance > 0 && stats.standard_error > settings.tolerance) {
        stats.notes.push_back(
            fmt::format("paths chosen at random leave a standard error of {:.3g} a pixel, over the "
                        "tolerance {:.3g}: more samples lower it",
                        stats.standard_error, settings.tolerance));
    }
    if (settings.tolerance > 0 && stats.error_bound > settings.tolerance) {
        stats.notes.push_back(fmt::format("the error bound {:.3g} is over the tolerance {:.3g}",
                                          stats.error_bound, settings.tolerance));
    }
    stats.effects.assign(plan.effects.begin(), plan.effects.end());
    stats.wavelengths_nm = plan.wavelengths_nm;
    stats.seconds_shade = seconds_since(shading);
    return result;
}

}  // namespace culet
