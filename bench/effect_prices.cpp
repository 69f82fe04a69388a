#include "bench/effect_prices.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <glm/geometric.hpp>
#include <numbers>

#include "render/beams/frame_renderer.h"
#include "render/render.h"
#include "stone/text/errors.h"
#include "tests/cpu_time.h"
#include "tests/render/plan_scenes.h"

namespace culet {

namespace {

constexpr int k_rays = 9, k_pupil = 16, k_rounds = 4;
constexpr double k_cut = 1e-3, k_roulette = 1e-2, k_split = 0.1;
const std::vector<double> k_sodium{589.3}, k_three{450, 550, 610};

struct Price {
    const char *effect, *off, *on;  // and the two sides in words
    Scene without, with;
    bool by_beams = true, by_reference = true;
};

Scene with_effects(const char* material, int pixels, const std::vector<double>& nm,
                   const std::vector<Effects>& effects) {
    Scene scene = plan_scene_of(material, "round-brilliant", "smooth", pixels).scene;
    RenderSettings& settings = scene.settings;
    settings.effects_auto = false;
    settings.effects.fill(false);
    for (Effects effect : effects) settings.effects[static_cast<std::size_t>(effect)] = true;
    settings.wavelengths_nm = nm;
    settings.threads = 1;
    settings.samples = k_rays;
    settings.tolerance = k_cut;
    const bool splits =
        std::find(effects.begin(), effects.end(), Effects::birefringence) != effects.end();
    settings.cut_weight = splits ? k_roulette : k_cut;
    settings.split_weight = k_split;
    settings.crystal_beams = CrystalBeams::merged;
    return scene;
}

std::shared_ptr<const EnvironmentMap> clouds() {
    auto map = std::make_shared<EnvironmentMap>();
    map->width = 512;
    map->height = 256;
    for (int y = 0; y < map->height; ++y) {
        for (int x = 0; x < map->width; ++x) {
            const double u = 2 * std::numbers::pi * x / map->width,
                         v = std::numbers::pi * (y + 0.5) / map->height;
            const double light = 1 + std::sin(v) * (0.5 * std::sin(3 * u) + 0.4 * std::cos(11 * u));
            for (int c = 0; c < 3; ++c) map->rgb.push_back(static_cast<float>(light));
        }
    }
    return map;
}

std::vector<Price> prices_of(int pixels) {
    using E = Effects;
    const auto scene = [&](const char* material, const std::vector<double>& nm,
                           const std::vector<E>& effects) {
        return with_effects(material, pixels, nm, effects);
    };
    const auto changed = [](Scene s, const std::function<void(Scene&)>& change) {
        change(s);
        return s;
    };
    const Scene plain = scene("cubic_zirconia", k_sodium, {});
    const Scene clear = scene("cubic_zirconia", k_three, {});
    const Scene split = scene("corundum", k_sodium, {E::birefringence});
    const Scene coherent = changed(split, [](Scene& s) {
        s.settings.effects[static_cast<std::size_t>(E::coherence)] = true;
        s.settings.bandwidth_nm = 10;
    });
    const Scene ruby = scene("ruby_pale", k_three, {E::birefringence, E::absorption});
    const Scene coloured = scene("garnet_almandine", k_three, {E::absorption});
    const Scene near = changed(plain, [](Scene& s) {
        const double size = diameter(s.stone.solid);
        s.lights.sources.push_back(SphereLight{{2 * size, 0, 2 * size}, 0.5 * size, {2.0}});
    });
    return {
        {"dispersion", "3 wavelengths, one way", "3 ways", clear,
         scene("cubic_zirconia", k_three, {E::dispersion})},
        {"birefringence", "one wave", "two waves (beams: merged)", scene("corundum", k_sodium, {}),
         split},
        {"birefringence", "one wave", "two waves, split", scene("corundum", k_sodium, {}),
         changed(split, [](Scene& s) { s.settings.crystal_beams = CrystalBeams::split; }), true,
         false},
        {"polarization", "mean of s and p", "exact", plain,
         scene("cubic_zirconia", k_sodium, {E::polarization})},
        {"absorption", "clear", "along every segment", scene("garnet_almandine", k_three, {}),
         coloured},
        {"pleochroism", "all waves alike", "each wave", ruby,
         scene("ruby_pale", k_three, {E::birefringence, E::absorption, E::pleochroism})},
        {"coherence", "powers add", "waves interfere", split, coherent},
        {"aperture", "pinhole", "16 points of the pupil",
         changed(plain, [](Scene& s) { s.settings.samples = k_pupil; }),
         changed(plain,
                 [](Scene& s) {
                     s.settings.samples = k_pupil;
                     s.settings.effects[static_cast<std::size_t>(E::aperture)] = true;
                     s.camera.aperture_radius = 0.05 * diameter(s.stone.solid);
                     s.camera.focus_distance = glm::length(s.camera.position - s.camera.look_at);
                 })},
        {"depth", "paths above 0.01", "above 0.0001",
         changed(plain, [](Scene& s) { s.settings.cut_weight = s.settings.tolerance = 1e-2; }),
         changed(plain, [](Scene& s) { s.settings.cut_weight = s.settings.tolerance = 1e-4; })},
        {"wavelengths", "3, absorbed", "29, absorbed", coloured,
         changed(coloured,
                 [](Scene& s) {
                     s.settings.wavelengths_nm.clear();
                     for (int i = 0; i < 29; ++i) s.settings.wavelengths_nm.push_back(410 + 10 * i);
                 })},
        {"samples", "1 ray", "9 rays", changed(plain, [](Scene& s) { s.settings.samples = 1; }),
         plain, false},
        {"light_edges", "three lobes", "three discs", plain,
         changed(plain,
                 [](Scene& s) {
                     for (Light& light : s.lights.sources) {
                         if (const auto* lobe = std::get_if<CosinePowerLight>(&light))
                             light = DiscLight{Vec3(lobe->direction), 0, 0.4,
                                               LightColour(lobe->radiance)};
                     }
                 })},
        {"environment_filter", "constant light", "a map of 512 x 256",
         changed(clear,
                 [](Scene& s) {
                     s.lights = {};
                     s.lights.constant = 1;
                 }),
         changed(clear,
                 [](Scene& s) {
                     s.lights = {};
                     s.lights.environment = clouds();
                 })},
        {"objects", "distant lights", "a near sphere too", plain, near},
    };
}

double seconds(Scene scene, const char* engine) {
    scene.settings.engine = engine;
    if (engine == std::string("reference")) {
        const Clocks start = clocks();
        render(scene);
        return clocks().cpu - start.cpu;
    }
    FrameRenderer frames(scene);
    frames.draw();
    // A few frames, since one may take a millisecond.
    constexpr int k_frames = 5;
    const Clocks start = clocks();
    for (int i = 0; i < k_frames; ++i) {
        frames.look_from(scene.camera);
        frames.draw();
    }
    return (clocks().cpu - start.cpu) / k_frames;
}

}  // namespace

void print_effect_prices(int pixels) {
    fmt::print(
        "| effect | off | on | engine | off, ms | on, ms | on / off |\n"
        "|---|---|---|---|---|---|---|\n");
    for (const Price& price : prices_of(pixels)) {
        for (const char* engine : {"reference", "beams"}) {
            const bool beams = engine == std::string("beams");
            if (!(beams ? price.by_beams : price.by_reference)) continue;
            double off = 1e300, on = 1e300;
            try {
                for (int round = 0; round < k_rounds; ++round) {
                    off = std::min(off, seconds(price.without, engine));
                    on = std::min(on, seconds(price.with, engine));
                }
                fmt::print("| {} | {} | {} | {} | {:.3g} | {:.3g} | {:.2f} |\n", price.effect,
                           price.off, price.on, engine, 1e3 * off, 1e3 * on, on / off);
            } catch (const InputError& error) {
                fmt::print("| {} | {} | {} | {} | - | - | {} |\n", price.effect, price.off,
                           price.on, engine, error.what());
            }
            std::fflush(stdout);
        }
    }
}

}  // namespace culet
