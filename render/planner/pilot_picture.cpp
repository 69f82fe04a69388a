#include "render/planner/pilot_picture.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>

#include "render/geometry/stone_body.h"
#include "render/optics/eye_optics.h"
#include "render/reference/light_field.h"
#include "render/reference/pixel_shader.h"
#include "render/work/listener.h"
#include "render/work/price.h"
#include "render/work/threads.h"
#include "render/work/work_meter.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

// Grid points along the longer side, to find the stone.
constexpr int k_looked_at = 64;

struct Window {
    double x0, y0, x1, y1;
};

std::vector<std::pair<int, int>> covered(const Scene& scene, const StoneBody& body,
                                         const EyeRays& eyes, const Window& window, double step) {
    std::vector<std::pair<int, int>> found;
    EntryGuess guess;
    int number = 0;
    for (double y = window.y0; y < window.y1; y += step) {
        for (double x = window.x0; x < window.x1; x += step, ++number) {
            // The golden ratio and its analogue in two dimensions (Roberts 2018): no grid of facets
            // resonates with them.
            const int px = static_cast<int>(x + step * std::fmod(number * 0.6180339887498949, 1.0)),
                      py = static_cast<int>(y + step * std::fmod(number * 0.7548776662466927, 1.0));
            if (px >= scene.camera.width || py >= scene.camera.height) continue;
            if (!eyes.sees(px + 0.5, py + 0.5)) continue;
            const EyeRay ray = eyes.through(px + 0.5, py + 0.5);
            if (body.entry(ray.origin, ray.direction, guess)) found.emplace_back(px, py);
        }
    }
    return found;
}

// Reorders rows of pixels by the golden ratio, so that every range covers all of them.
std::vector<std::pair<int, int>> spread_evenly(const std::vector<std::pair<int, int>>& rows) {
    const std::size_t count = rows.size();
    std::vector<std::pair<double, std::size_t>> order;
    for (std::size_t i = 0; i < count; ++i)
        order.emplace_back(std::fmod(0.6180339887498949 * static_cast<double>(i), 1.0), i);
    // Invert the permutation of ranks: the i-th pixel is where a step of the golden ratio lands.
    std::sort(order.begin(), order.end());
    std::vector<std::pair<int, int>> spread(count);
    for (std::size_t rank = 0; rank < count; ++rank) spread[order[rank].second] = rows[rank];
    return spread;
}

}  // namespace

StonePixels StonePixels::range(std::size_t first, std::size_t count) const {
    StonePixels some;
    some.in_picture = in_picture;
    const std::size_t end = std::min(at.size(), first + count);
    for (std::size_t i = first; i < end; ++i) some.at.push_back(at[i]);
    return some;
}

StonePixels stone_pixels(const Scene& scene, int wanted) {
    const StoneBody body(scene.stone.solid, scene.stone.convex);
    const EyeRays eyes(scene.camera);
    const double width = scene.camera.width, height = scene.camera.height;
    const auto look = [&](Window window, double step) {
        StonePixels pixels;
        pixels.at = covered(scene, body, eyes, window, step);
        pixels.in_picture = static_cast<double>(pixels.at.size()) * step * step;
        return pixels;
    };
    const Window whole{0, 0, width, height};
    const double side = std::max(width, height);
    double step = std::max(1.0, side / k_looked_at);
    StonePixels pixels = look(whole, step);
    if (pixels.at.empty()) return pixels;
    if (static_cast<int>(pixels.at.size()) < wanted && step > 1) {
        // A small stone: search again around it.
        Window window{width, height, 0, 0};
        for (const auto& [x, y] : pixels.at) {
            window.x0 = std::min(window.x0, std::max(0.0, x - step));
            window.y0 = std::min(window.y0, std::max(0.0, y - step));
            window.x1 = std::max(window.x1, std::min(width, x + step));
            window.y1 = std::max(window.y1, std::min(height, y + step));
        }
        const double around = std::max(window.x1 - window.x0, window.y1 - window.y0);
        step = std::max(1.0, around / k_looked_at);
        pixels = look(window, step);
    }
    pixels.at = spread_evenly(pixels.at);
    if (static_cast<int>(pixels.at.size()) > wanted)
        pixels.at.resize(static_cast<std::size_t>(wanted));
    return pixels;
}

StonePixels all_stone_pixels(const Scene& scene) {
    const StoneBody body(scene.stone.solid, scene.stone.convex);
    const Window whole{0, 0, double(scene.camera.width), double(scene.camera.height)};
    StonePixels pixels;
    pixels.at = spread_evenly(covered(scene, body, EyeRays(scene.camera), whole, 1));
    pixels.in_picture = static_cast<double>(pixels.at.size());
    return pixels;
}

namespace {

void add_sums(const std::vector<PixelSums>& sums, PilotDrawing& drawing) {
    PixelSums whole;
    for (const PixelSums& sum : sums) {
        whole += sum;
        drawing.halves_apart.push_back(sum.halves_apart);
    }
    const double count = static_cast<double>(sums.size());
    for (const Rgb& rgb : drawing.rgb) drawing.mean += (rgb[0] + rgb[1] + rgb[2]) / (3 * count);
    drawing.rays = static_cast<double>(whole.rays);
    drawing.events = static_cast<double>(whole.events);
    if (whole.hit > 0) {
        drawing.remainder = whole.remainder / whole.hit;
        drawing.cut = whole.cut / whole.hit;
        drawing.absorbed = whole.absorbed / whole.hit;
    }
    if (whole.radiance > 0) drawing.few_rays = whole.halves_apart / whole.radiance;
}

}  // namespace

PilotDrawing draw_pilot(const Scene& scene, const StonePixels& pixels, const PathLimits& limits,
                        int samples, int nodes, const Progress& progress) {
    using Clock = std::chrono::steady_clock;
    const PreparedScene prepared(scene, nodes, limits);
    const OpticalSetup& setup = prepared.setup;
    const WavelengthSet& colours = prepared.colours;
    const PixelShader shader(scene, prepared, samples);
    const std::vector<Stokes> behind = responses(scene.camera.optics, setup.wavelengths_nm);

    PilotDrawing drawing;
    drawing.wavelengths_nm = setup.wavelengths_nm;
    drawing.brightest = prepared.surroundings->max_radiance();
    drawing.rgb.resize(pixels.at.size());
    std::vector<PixelSums> sums(pixels.at.size());
    const int wavelengths = colours.size();
    drawing.spectra.resize(pixels.at.size() * static_cast<std::size_t>(wavelengths));
    std::atomic<long long> nanoseconds{0};
    Listener listener(progress);
    WorkMeter* const meter = scene.settings.meter.get();
    const PathWork of_a_ray = work_along_paths(setup);
    on_threads(scene.settings.threads, [&] {
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, pixels.at.size(), 8), [&](const auto&
                                                                                           range) {
            const auto start = Clock::now();
            PixelMemory memory;
            memory.goes_on = [&listener] { return listener.still_goes_on(); };
            std::vector<double> stokes(static_cast<std::size_t>(wavelengths * shader.planes()));
            for (std::size_t p = range.begin(); p < range.end() && listener.goes_on(); ++p) {
                const auto [x, y] = pixels.at[p];
                const std::uint64_t number =
                    static_cast<std::uint64_t>(y) * static_cast<std::uint64_t>(scene.camera.width) +
                    static_cast<std::uint64_t>(x);
                sums[p] = shader.shade(x, y, 1, number, stokes.data(), memory);
                if (meter != nullptr) {
                    PathWork work = of_a_ray;
                    work.rays = static_cast<double>(sums[p].rays);
                    work.events = static_cast<double>(sums[p].events);
                    meter->spend(price_ns(work));
                    if (meter->over()) return;
                }
                look_through(behind, shader.planes(), stokes.data());
                drawing.rgb[p] = colours.rgb_of(stokes.data());
                std::copy_n(stokes.begin(), wavelengths,
                            drawing.spectra.begin() + static_cast<long>(p) * wavelengths);
            }
            nanoseconds +=
                std::chrono::duration_cast<std::chrono::nanoseconds>(Clock::now() - start).count();
        });
    });
    if (listener.stopped()) throw Interrupted();
    if (meter != nullptr) meter->require_not_over();
    add_sums(sums, drawing);
    drawing.surroundings_ns = prepared.surroundings->spent_ns();
    drawing.seconds = 1e-9 * static_cast<double>(nanoseconds);
    return drawing;
}

}  // namespace culet
