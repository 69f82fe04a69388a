// Compares the reference renderer with POV-Ray 3.7: the same scenes at max_trace_level 2..10, the
// difference of the pictures, and the CPU time of each on one thread. docs/rendering.md explains
// the results.
//
//   against_povray [PIXELS [SCENE.toml]]      a table on stdout
//
// Without a scene: a round brilliant of 73 facets in diamond's index, tilted, under four lights.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <iostream>

#include "bench/povray_run.h"
#include "render/render.h"
#include "render/scene/scene_io.h"
#include "stone/text/errors.h"
#include "tests/cpu_time.h"

namespace {

using namespace culet;

struct NamedScene {
    std::string name;
    Scene scene;
};

std::vector<NamedScene> own_scenes() {
    Scene scene;
    scene.stone.solid =
        read_solid(CULET_SOURCE_DIR "/tests/stone/designs/srb_class_angles.asc").solid;
    scene.stone.material = catalogue_material("diamond");
    scene.camera.position = {2.5, 1, 6};
    scene.camera.fov = 0.18;
    // No light above 1, so that a PNG can hold it.
    Lights constant, sky, rings, lobes;
    constant.constant = 1;
    sky.constant = 0.1;
    sky.sources.push_back(HemisphereLight{glm::normalize(Vec3{0.1, 0.2, 1}), {0.9}});
    rings.sources.push_back(DiscLight{{0, 0, 1}, 0, 0.26, {0.3}});
    rings.sources.push_back(DiscLight{{0, 0, 1}, 0.26, 0.78, {1.0}});
    rings.sources.push_back(DiscLight{{0, 0, 1}, 0.78, 1.57, {0.6}});
    lobes.constant = 0.05;
    lobes.sources.push_back(CosinePowerLight{glm::normalize(Vec3{0.3, 0.2, 1}), 3, {0.6}});
    lobes.sources.push_back(CosinePowerLight{glm::normalize(Vec3{-1, 0.4, 0.2}), 8, {0.35}});
    std::vector<NamedScene> scenes;
    for (const auto& [name, lights] : {std::pair{"constant", constant},
                                       {"hemisphere", sky},
                                       {"three rings", rings},
                                       {"two lobes", lobes}}) {
        scene.lights = lights;
        scenes.push_back({name, scene});
    }
    return scenes;
}

struct Timed {
    Picture picture;
    double seconds = 0;
};

// The quickest of three, since other load can only add time.
Timed with_culet(Scene scene, bool polarised) {
    scene.settings.effects_auto = false;
    scene.settings.effects.fill(false);
    scene.settings.effects[static_cast<std::size_t>(Effects::polarization)] = polarised;
    scene.settings.effects[static_cast<std::size_t>(Effects::absorption)] = true;
    Timed result;
    result.seconds = quickest([&] { result.picture = render(scene).picture; }, 3, 0).cpu;
    return result;
}

struct Difference {
    double rmse = 0, largest = 0, mean = 0, most = 0;
    int over = 0;  ///< pixels that differ by more than 0.01
    double rmse_of_others = 0;
};

Difference difference(const Picture& a, const Picture& b) {
    Difference d;
    double squares = 0, others = 0, sum = 0;
    for (std::size_t i = 0; i < a.pixels(); ++i) {
        double here = 0;
        for (std::size_t c = 0; c < 3; ++c) {
            const double e = std::abs(static_cast<double>(a.rgb[3 * i + c]) - b.rgb[3 * i + c]);
            here = std::max(here, e);
            squares += e * e;
            if (e <= 0.01) others += e * e;
            sum += a.rgb[3 * i + c];
            d.most = std::max(d.most, static_cast<double>(a.rgb[3 * i + c]));
        }
        d.largest = std::max(d.largest, here);
        d.over += here > 0.01;
    }
    const double values = 3 * static_cast<double>(a.pixels());
    d.rmse = std::sqrt(squares / values);
    d.rmse_of_others = std::sqrt(others / values);
    d.mean = sum / values;
    return d;
}

int run(int argc, char** argv) {
    const int pixels = argc > 1 ? std::atoi(argv[1]) : 400;
    std::vector<NamedScene> scenes;
    if (argc > 2) {
        scenes.push_back({argv[2], read_scene(argv[2])});
    } else {
        scenes = own_scenes();
    }
    const PovrayFolder folder;
    std::cout << fmt::format(
        "{} x {} pixels; RMSE and differences of linear radiance, CPU seconds\n", pixels, pixels);
    for (NamedScene& named : scenes) {
        Scene& scene = named.scene;
        scene.camera.width = scene.camera.height = pixels;
        scene.settings.threads = 1;
        scene.settings.samples = 1;
        scene.settings.tolerance = 0;
        if (scene.settings.wavelengths_nm.size() != 1) scene.settings.wavelengths_nm = {589.3};
        std::cout << fmt::format(
            "\n{}\n{:>5} {:>6} {:>9} {:>9} {:>9} {:>6} {:>9} | {:>8} {:>8} {:>8} | {:>6} {:>6}\n",
            named.name, "level", "mean", "RMSE", "relative", "largest", "over", "others", "POV-Ray",
            "scalar", "polar.", "x", "x pol.");
        for (int level = 2; level <= 10; ++level) {
            scene.settings.depth = level - 1;
            const Timed ours = with_culet(scene, false), polarised = with_culet(scene, true);
            const PovrayRun theirs = folder.draw(scene, "-A", 3);
            const Difference d = difference(ours.picture, theirs.picture);
            std::cout << fmt::format(
                             "{:>5} {:>6.4f} {:>9.2e} {:>9.2e} {:>9.2e} {:>6} {:>9.2e} | {:>8.3f} "
                             "{:>8.3f} {:>8.3f} | {:>6.1f} {:>6.1f}\n",
                             level, d.mean, d.rmse, d.rmse / d.mean, d.largest, d.over,
                             d.rmse_of_others, theirs.seconds, ours.seconds, polarised.seconds,
                             theirs.seconds / ours.seconds, theirs.seconds / polarised.seconds)
                      << std::flush;
        }
    }
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        return run(argc, argv);
    } catch (const std::exception& error) {
        std::cerr << "against_povray: " << error.what() << "\n";
        return 2;
    }
}
