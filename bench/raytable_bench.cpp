// Compares ray tables with the reference: bench_raytable [PIXELS]
//
// Uses the round brilliant of bench_scenes.h at depth 5, one ray per pixel, on one thread. Measures
// the table's size, the time to make it and to relight, and the pictures' error against the
// reference along the same rays. Then the same with a body colour, with dispersion, for a crystal,
// and for a stone that is not convex. Errors are over the stone's pixels, relative to their mean;
// "worst" is the largest difference relative to the brightest pixel.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <glm/geometric.hpp>
#include <numbers>
#include <string>

#include "bench/view_interpolation.h"
#include "render/engine/engine.h"
#include "render/raytable/relighting.h"
#include "render/raytable/table_maker.h"
#include "render/scene/light_presets.h"
#include "stone/cuts/cuts.h"
#include "stone/material/material_io.h"
#include "tests/cpu_time.h"
#include "tests/render/bench_scenes.h"
#include "tests/render/carved_solids.h"

namespace culet {
namespace {

struct PictureError {
    double mean = 0, worst = 0;
};

PictureError error_of(const Picture& picture, const Picture& truth) {
    double sum = 0, whole = 0, worst = 0, brightest = 0;
    for (std::size_t pixel = 0; pixel < truth.pixels(); ++pixel) {
        for (std::size_t c = 3 * pixel; c < 3 * pixel + 3; ++c) {
            const double off =
                std::abs(static_cast<double>(picture.rgb[c]) - static_cast<double>(truth.rgb[c]));
            worst = std::max(worst, off);
            brightest = std::max(brightest, static_cast<double>(truth.rgb[c]));
            if (!(truth.coverage[pixel] > 0)) continue;
            sum += off;
            whole += static_cast<double>(truth.rgb[c]);
        }
    }
    return {sum / whole, worst / brightest};
}

double reference_ms(const Scene& scene, Picture& picture) {
    Scene drawn = scene;
    drawn.settings.engine = k_reference_engine;
    const Clocks start = clocks();
    picture = engine_of(drawn.settings).draw(drawn, {}).picture;
    return 1e3 * (clocks().cpu - start.cpu);
}

// One line per light; the table is made once.
void measure(const std::string& what, Scene scene,
             const std::vector<std::pair<std::string, Lights>>& lights) {
    scene.settings.samples = 1;
    scene.settings.threads = 1;
    const Clocks start = clocks();
    const RayTable made = make_ray_table(scene, table_rays(scene), {});
    const double make_ms = 1e3 * (clocks().cpu - start.cpu);
    const std::filesystem::path file =
        std::filesystem::temp_directory_path() / fmt::format("bench_raytable.{}.rays", clock());
    made.write(file);
    const Clocks open = quickest([&] { (void)RayTable::open(file); }, 3, 0.1);
    const RayTable table = RayTable::open(file);
    std::filesystem::remove(file);
    const RayTableHeader& header = table.header();
    fmt::print(
        "{}: {} rays x {} bands meet the stone, {} exits, {:.1f} MB; made in {:.0f} ms, "
        "opened and checked in {:.1f} ms; remainder {:.2g}, cut {:.2g}\n",
        what, header.hits, header.bands, header.exits, static_cast<double>(table.bytes()) / 1e6,
        make_ms, 1e3 * open.cpu, header.remainder, header.cut);
    fmt::print("  {:<28} {:>9} {:>9} {:>12} {:>10} {:>10} {:>9}\n", "light", "relit ms",
               "double ms", "reference ms", "error", "worst", "off 1e-3");
    for (const auto& [name, light] : lights) {
        Scene lit = scene;
        lit.lights = light;
        const TableRays rays = table_rays(lit, table.parts().wavelengths_nm);
        if (const std::string other = difference_to(header, lit, rays); !other.empty()) {
            fmt::print("  {:<28} does not fit: {}\n", name, other);
            continue;
        }
        RenderResult result, exact;
        const Clocks relight = quickest([&] { result = relit(table, lit, rays, {}); }, 10, 0.5);
        const Clocks slow = quickest(
            [&] { exact = relit(table, lit, rays, {}, ExitPrecision::double_precision); }, 1, 0);
        Picture truth;
        const double reference = reference_ms(lit, truth);
        const PictureError error = error_of(result.picture, truth);
        float brightest = 0;
        for (const float v : truth.rgb) brightest = std::max(brightest, v);
        long long off = 0;
        for (std::size_t i = 0; i < truth.rgb.size(); i += 3)
            off += std::abs(result.picture.rgb[i] - truth.rgb[i]) > 1e-3f * brightest;
        fmt::print("  {:<28} {:9.2f} {:9.1f} {:12.0f} {:10.2g} {:10.2g} {:9}\n", name,
                   1e3 * relight.cpu, 1e3 * slow.cpu, reference, error.mean, error.worst, off);
    }
}

Lights with_environment() {
    // A sky with a sun of two degrees and clouds: 1024 x 512 texels.
    auto map = std::make_shared<EnvironmentMap>();
    map->width = 1024;
    map->height = 512;
    for (int y = 0; y < map->height; ++y) {
        for (int x = 0; x < map->width; ++x) {
            const double cloud = 0.5 + 0.5 * std::sin(0.11 * x) * std::cos(0.17 * y);
            const double sun = std::hypot(x - 300, y - 130) < 3 ? 200 : 0;
            map->rgb.push_back(static_cast<float>(0.2 + 0.6 * cloud + sun));
            map->rgb.push_back(static_cast<float>(0.3 + 0.5 * cloud + sun));
            map->rgb.push_back(static_cast<float>(0.5 + 0.3 * cloud + sun));
        }
    }
    Lights lights;
    lights.environment = map;
    return lights;
}

// Close to the stone, one in front of the other.
Lights near_lights(const Scene& scene) {
    const double size = diameter(scene.stone.solid);
    Lights lights;
    lights.constant = 0.1;
    lights.sources.push_back(SphereLight{Vec3{-size, size, 2 * size}, 0.5 * size, {4.0}});
    lights.sources.push_back(SphereLight{Vec3{-2 * size, 2 * size, 4 * size}, 1.5 * size, {1.0}});
    PlaneLight panel;
    panel.point = {-2 * size, 0, 2 * size};
    panel.normal = glm::normalize(Vec3{1, 0, -1});
    panel.u = Vec3{0, size, 0};
    panel.v = size * glm::normalize(Vec3{1, 0, 1});
    panel.radiance = {2.0};
    lights.sources.push_back(panel);
    return lights;
}

// Halfway between stored views: the middle of a grid cell is farthest from all.
void measure_views(Scene scene) {
    scene.settings.samples = 1;
    scene.settings.threads = 1;
    fmt::print(
        "between views, {} x {} pixels\n  {:<8} {:>6} {:>9} {:>16} {:>9} {:>10} {:>14} {:>12}\n",
        scene.camera.width, scene.camera.height, "step", "views", "MB of all", "interpolated ms",
        "relit ms", "error", "off over 0.05", "plain mean");
    const double distance = glm::length(scene.camera.position - scene.camera.look_at);
    for (const double step : {0.1, 0.05, 0.025, 0.0125}) {
        const double polar = std::numbers::pi / std::ceil(std::numbers::pi / step),
                     azimuth = 2 * std::numbers::pi / std::ceil(2 * std::numbers::pi / step);
        const double theta = (std::floor(0.35 / polar) + 0.5) * polar,
                     phi = (std::floor(0.3 / azimuth) + 0.5) * azimuth;
        Scene between = scene;
        between.camera.position = between.camera.look_at +
                                  distance * Vec3{std::sin(theta) * std::cos(phi),
                                                  std::sin(theta) * std::sin(phi), std::cos(theta)};
        const TableRays rays = table_rays(between);
        std::vector<ViewTable> tables;
        double bytes = 0;
        for (const StoredView& view : stored_views(between.camera, step)) {
            Scene seen = between;
            seen.camera = view.camera;
            tables.push_back({view, make_ray_table(seen, rays, {})});
            bytes += static_cast<double>(tables.back().table.bytes());
        }
        const Clocks start = clocks();
        const RayTable table = interpolated(between, rays, tables, {});
        const double made = clocks().cpu - start.cpu;
        RenderResult result;
        const Clocks relight = quickest([&] { result = relit(table, between, rays, {}); }, 3, 0.1);
        Picture truth;
        reference_ms(between, truth);
        const PictureError error = error_of(result.picture, truth);
        // The error of the mean of the stored views' pictures.
        Picture mix = truth;
        std::fill(mix.rgb.begin(), mix.rgb.end(), 0.0f);
        for (const ViewTable& stored : tables) {
            Scene seen = between;
            seen.camera = stored.view.camera;
            const Picture one = relit(stored.table, seen, rays, {}).picture;
            for (std::size_t i = 0; i < one.rgb.size(); ++i)
                mix.rgb[i] += static_cast<float>(stored.view.share) * one.rgb[i];
        }
        double mean = 0, hits = 0, off = 0;
        for (std::size_t i = 0; i < truth.pixels(); ++i) {
            if (!(truth.coverage[i] > 0)) continue;
            mean += static_cast<double>(truth.rgb[3 * i]);
            hits += 1;
        }
        for (std::size_t i = 0; i < truth.pixels(); ++i)
            off += std::abs(static_cast<double>(result.picture.rgb[3 * i] - truth.rgb[3 * i])) >
                   0.05 * mean / hits;
        fmt::print("  {:<8} {:6} {:9.1f} {:16.0f} {:9.2f} {:10.3f} {:13.1f}% {:12.3f}\n", step,
                   tables.size(), bytes / 1e6, 1e3 * made, 1e3 * relight.cpu, error.mean,
                   100 * off / hits, error_of(mix, truth).mean);
    }
}

void run(int pixels) {
    fmt::print("{} x {} pixels, one thread, quickest of ten and more\n", pixels, pixels);
    Scene brilliant = base_scene(pixels);
    brilliant.settings.depth = 5;
    set_polarised(brilliant, true);
    const std::vector<std::pair<std::string, Lights>> all{
        {"constant and three lobes", smooth_lights()},
        {"jeweller", *light_preset("jeweller")},
        {"aset (grey: one wavelength)", *light_preset("aset")},
        {"daylight (likewise)", *light_preset("daylight")},
        {"two balls and a panel", near_lights(brilliant)},
        {"environment 1024 x 512", with_environment()}};
    measure("diamond, depth 5", brilliant, all);
    measure_views(brilliant);
    Scene colours = brilliant;
    colours.settings.wavelengths_nm = {450, 550, 610};
    colours.settings.effects[static_cast<std::size_t>(Effects::dispersion)] = false;
    measure("the same in three wavelengths", colours,
            {{"jeweller", *light_preset("jeweller")},
             {"aset", *light_preset("aset")},
             {"daylight", *light_preset("daylight")},
             {"environment 1024 x 512", with_environment()}});
    Scene red = colours;
    red.stone.material = catalogue_material("diamond");
    red.stone.material.absorption_per_mm[0] = Spectrum({450, 550, 610}, {0.3, 0.6, 0.02});
    measure("the same with a body colour", red, {{"jeweller", *light_preset("jeweller")}});

    const int few = std::max(pixels / 2, 1);
    Scene fire = base_scene(few);
    fire.settings.depth = 8;
    fire.settings.wavelengths_nm = {450, 500, 550, 600, 650};
    measure("diamond with dispersion, depth 8", fire, {{"jeweller", *light_preset("jeweller")}});

    Scene crystal = base_scene(std::max(pixels / 4, 1));
    crystal.stone.material = catalogue_material("sapphire_blue");
    crystal.settings.effects[static_cast<std::size_t>(Effects::coherence)] = false;
    crystal.settings.depth = 6;
    measure("sapphire, whole trees of depth 6", crystal,
            {{"constant and three lobes", smooth_lights()}});
    crystal.settings.tolerance = 0.01;
    crystal.settings.depth = 12;
    measure("sapphire, depth 12, cut at 1e-3", crystal,
            {{"constant and three lobes", smooth_lights()}});

    Scene star = base_scene(std::max(pixels / 4, 1));
    star.stone.solid = carved::star_prism();
    star.stone.convex = false;
    star.camera = bench_camera(star.stone.solid, 6, bench_view(), std::max(pixels / 4, 1));
    star.settings.depth = 6;
    measure("a star, not convex, whole trees of depth 6", star,
            {{"constant and three lobes", smooth_lights()}});
}

}  // namespace
}  // namespace culet

int main(int argc, char** argv) {
    culet::run(argc > 1 ? std::atoi(argv[1]) : 800);
}
