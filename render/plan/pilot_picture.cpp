#include "render/plan/pilot_picture.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>

#include "render/eye_optics.h"
#include "render/pixel_shader.h"
#include "render/stone_body.h"
#include "render/threads.h"

namespace culet {

namespace {

constexpr int k_looked_at = 64;  // pixels along the longer side, to find the stone

struct Window {
    double x0, y0, x1, y1;
};

// Pixels of a jittered grid whose middle the stone covers.
std::vector<std::pair<int, int>> covered(const Scene& scene, const StoneBody& body,
                                         const EyeRays& eyes, const Window& window, double step) {
    std::vector<std::pair<int, int>> found;
    EntryGuess guess;
    int number = 0;
    for (double y = window.y0; y < window.y1; y += step) {
        for (double x = window.x0; x < window.x1; x += step, ++number) {
            // The golden ratio and its like in two dimensions (Roberts 2018): no grid of facets
            // falls in with them.
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

}  // namespace

StonePixels stone_pixels(const Scene& scene, int wanted) {
    const StoneBody body(scene.stone.solid, scene.stone.convex);
    const EyeRays eyes(scene.camera);
    const double width = scene.camera.width, height = scene.camera.height;
    Window window{0, 0, width, height};
    double step = std::max(1.0, std::max(width, height) / k_looked_at);
    StonePixels pixels;
    pixels.at = covered(scene, body, eyes, window, step);
    if (pixels.at.empty()) return pixels;
    if (static_cast<int>(pixels.at.size()) < wanted && step > 1) {
        // A small stone: once more, where it is.
        window = {width, height, 0, 0};
        for (const auto& [x, y] : pixels.at) {
            window.x0 = std::min(window.x0, std::max(0.0, x - step));
            window.y0 = std::min(window.y0, std::max(0.0, y - step));
            window.x1 = std::max(window.x1, std::min(width, x + step));
            window.y1 = std::max(window.y1, std::min(height, y + step));
        }
        const double side = std::max(window.x1 - window.x0, window.y1 - window.y0);
        step = std::max(1.0, side / k_looked_at);
        pixels.at = covered(scene, body, eyes, window, step);
    }
    pixels.in_picture = static_cast<double>(pixels.at.size()) * step * step;
    // As many as are wanted, at even steps through the rows.
    if (static_cast<int>(pixels.at.size()) > wanted) {
        std::vector<std::pair<int, int>> chosen;
        const double stride = static_cast<double>(pixels.at.size()) / wanted;
        for (int i = 0; i < wanted; ++i)
            chosen.push_back(pixels.at[static_cast<std::size_t>((i + 0.5) * stride)]);
        pixels.at = std::move(chosen);
    }
    return pixels;
}

PilotDrawing draw_pilot(const Scene& scene, const StonePixels& pixels, const PathLimits& limits,
                        int samples, int nodes) {
    using Clock = std::chrono::steady_clock;
    const Plan plan = make_plan(scene, nodes);
    const WavelengthSet colours(plan.wavelengths_nm);
    const LightField lights(scene.lights, colours);
    PathLimits own = limits;
    own.polarised = plan.polarised;
    own.roulette = limits.roulette && (plan.splits || !scene.stone.convex);
    const PixelShader shader(scene, plan, lights, colours, own, samples);
    std::vector<Stokes> behind;
    for (double nm : plan.wavelengths_nm) behind.push_back(response(scene.camera.optics, nm));

    PilotDrawing drawing;
    drawing.wavelengths_nm = plan.wavelengths_nm;
    drawing.brightest = lights.max_radiance();
    drawing.rgb.resize(pixels.at.size());
    std::vector<PixelSums> sums(pixels.at.size());
    const int wavelengths = colours.size();
    std::atomic<long long> nanoseconds{0};
    on_threads(scene.settings.threads, [&] {
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, pixels.at.size(), 8), [&](const auto&
                                                                                           range) {
            const auto start = Clock::now();
            PixelMemory memory;
            std::vector<double> stokes(static_cast<std::size_t>(wavelengths * shader.planes()));
            for (std::size_t p = range.begin(); p < range.end(); ++p) {
                const auto [x, y] = pixels.at[p];
                const std::uint64_t number =
                    static_cast<std::uint64_t>(y) * static_cast<std::uint64_t>(scene.camera.width) +
                    static_cast<std::uint64_t>(x);
                sums[p] = shader.shade(x, y, 1, number, stokes.data(), memory);
                for (int i = 0; i < wavelengths && shader.planes() > 1; ++i) {
                    double seen = 0;
                    for (int k = 0; k < shader.planes(); ++k)
                        seen += behind[static_cast<std::size_t>(i)][static_cast<std::size_t>(k)] *
                                stokes[static_cast<std::size_t>(k * wavelengths + i)];
                    stokes[static_cast<std::size_t>(i)] = seen;
                }
                drawing.rgb[p] = colours.rgb_of(stokes.data());
            }
            nanoseconds +=
                std::chrono::duration_cast<std::chrono::nanoseconds>(Clock::now() - start).count();
        });
    });
    PixelSums whole;
    for (const PixelSums& sum : sums) whole += sum;
    const double count = static_cast<double>(pixels.at.size());
    for (const Rgb& rgb : drawing.rgb) drawing.mean += (rgb[0] + rgb[1] + rgb[2]) / (3 * count);
    drawing.rays = static_cast<double>(whole.rays);
    drawing.events = static_cast<double>(whole.events);
    if (whole.hit > 0) {
        drawing.remainder = whole.remainder / whole.hit;
        drawing.absorbed = whole.absorbed / whole.hit;
        drawing.few_rays = whole.radiance > 0 ? whole.halves_apart / whole.radiance : 0;
    }
    drawing.seconds = 1e-9 * static_cast<double>(nanoseconds);
    return drawing;
}

}  // namespace culet
