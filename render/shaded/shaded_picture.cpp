#include "render/shaded/shaded_picture.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <chrono>
#include <limits>

#include "render/reference/sampling.h"
#include "render/setup/scene_checks.h"
#include "render/work/listener.h"
#include "render/work/threads.h"
#include "stone/design/design.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

// Sums of one row; added in row order.
struct RowSums {
    double met = 0, luminance = 0;
    long long rays = 0;
};

RenderStats stats_of(const std::string& engine, const Camera& camera,
                     const std::vector<RowSums>& rows) {
    RowSums whole;
    for (const RowSums& row : rows) {
        whole.met += row.met;
        whole.luminance += row.luminance;
        whole.rays += row.rays;
    }
    RenderStats stats;
    stats.engine = engine;
    stats.rays = whole.rays;
    if (whole.met > 0) stats.mean_radiance = whole.luminance / whole.met;
    for (int e = 0; e < k_effect_count; ++e) {
        const auto effect = static_cast<Effects>(e);
        const bool on = effect == Effects::aperture && camera.aperture_radius > 0;
        stats.effects.push_back({effect, on,
                                 on ? "the camera has an aperture" : "a plain shading has none",
                                 on ? 0 : std::numeric_limits<double>::quiet_NaN()});
    }
    stats.error_bound = std::numeric_limits<double>::quiet_NaN();
    stats.notes.push_back("a plain shading, not a computation of light: docs/engines.md");
    return stats;
}

}  // namespace

std::string refused_by_shading(const Scene& scene) {
    if (scene.camera.optics.two_windows) return "a dichroscope's two windows need polarised light";
    if (scene.camera.optics.analyzer || scene.camera.optics.retarder)
        return "an analyser or retarder needs polarised light";
    if (scene.settings.spectral) return "plain shading has three primaries and no spectrum";
    return {};
}

void require_shadable(const Scene& scene) {
    require_renderable(scene);
    const std::string why = refused_by_shading(scene);
    if (!why.empty()) throw InputError(why + ": say engine = \"reference\"");
}

RenderResult shaded_picture(const Scene& scene, const std::string& engine, const SeeRay& see,
                            const Progress& progress) {
    const auto start = std::chrono::steady_clock::now();
    const Camera& camera = scene.camera;
    const EyeRays eyes(camera);
    const int samples = scene.settings.samples > 0 ? scene.settings.samples : k_shaded_samples;
    const std::vector<SamplePoint> pattern = sample_pattern(
        samples, camera.aperture_radius > 0, scene.settings.filter, scene.settings.filter_radius);
    RenderResult result;
    Picture& picture = result.picture;
    picture.width = camera.width;
    picture.height = camera.height;
    picture.rgb.resize(3 * picture.pixels());
    picture.coverage.resize(picture.pixels());
    std::vector<RowSums> rows(static_cast<std::size_t>(camera.height));
    Listener listener(progress, camera.height);
    const auto shade_row = [&](int y) {
        if (!listener.goes_on()) return;
        RowSums& sums = rows[static_cast<std::size_t>(y)];
        for (int x = 0; x < camera.width && listener.still_goes_on(); ++x) {
            const std::size_t pixel =
                static_cast<std::size_t>(y) * static_cast<std::size_t>(camera.width) +
                static_cast<std::size_t>(x);
            Rgb colour{0, 0, 0};
            int met = 0;
            for (std::size_t i = 0; i < pattern.size(); ++i) {
                const SamplePoint& p = pattern[i];
                if (!eyes.sees(x + p.x, y + p.y)) continue;
                const SeenColour seen = see(eyes.through(x + p.x, y + p.y, p.pupil_x, p.pupil_y),
                                            pixel * pattern.size() + i);
                for (std::size_t c = 0; c < 3; ++c) colour[c] += seen.colour[c] / samples;
                if (!seen.met) continue;
                ++met;
                sums.luminance += luminance(seen.colour) / samples;
            }
            for (std::size_t c = 0; c < 3; ++c)
                picture.rgb[3 * pixel + c] = static_cast<float>(colour[c]);
            picture.coverage[pixel] = static_cast<float>(met) / static_cast<float>(samples);
            sums.met += static_cast<double>(met) / samples;
            sums.rays += met;
        }
    };
    on_threads(scene.settings.threads, [&] { tbb::parallel_for(0, camera.height, shade_row); });
    if (listener.stopped()) throw Interrupted();
    result.stats = stats_of(engine, camera, rows);
    if (const std::string frosted = frosted_tiers(scene.stone.solid); !frosted.empty())
        result.stats.notes.push_back(fmt::format("frosted tiers are drawn polished: {}", frosted));
    result.stats.seconds_shade =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return result;
}

}  // namespace culet
