// Objects around the stone in the reference engine: the time of a ring, and pictures beside
// POV-Ray's where both compute the same (mirrors, glass, luminous objects). docs/objects.md has the
// figures.
//
//   bench_objects            a table on stdout

#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <iostream>

#include "bench/povray_run.h"
#include "render/render.h"
#include "render/scene/scene_io.h"
#include "stone/setting/setting.h"
#include "tests/cpu_time.h"

namespace {

using namespace culet;

Scene ring(int width, int height, int samples) {
    Scene scene;
    scene.stone.solid =
        read_solid(CULET_SOURCE_DIR "/tests/stone/designs/srb_class_angles.asc").solid;
    const double to_mm = 6.5 / width_along(scene.stone.solid, {1, 0, 0});
    for (Vec3& v : scene.stone.solid.vertices) v *= to_mm;
    for (Facet& f : scene.stone.solid.facets) f.plane.offset *= to_mm;
    scene.stone.material = catalogue_material("diamond");
    SettingOptions options;
    options.prongs = 6;
    const Setting setting = make_setting(scene.stone.solid, {0, 0, 1}, options);
    auto mesh = std::make_shared<TriangleMesh>();
    const Solid metal = mesh_of(setting);
    mesh->vertices = metal.vertices;
    for (const Facet& f : metal.facets)
        mesh->triangles.push_back({f.corners[0], f.corners[1], f.corners[2]});
    smooth_normals(*mesh, 0.5);
    scene.objects = {
        {MeshShape{mesh}, MetalMaterial{{1.0}, {0.0}, SurfaceColour{Rgb{0.67, 0.64, 0.59}}, 0.15}},
        {PlaneShape{{0, 0, -23.5}, {0, 0, 1}}, DiffuseMaterial{{0.5}}}};
    scene.camera.position = {39.6, -23.1, 24.3};
    scene.camera.look_at = {0, 0, -5.9};
    scene.camera.up = {0, 0, 1};
    scene.camera.width = width;
    scene.camera.height = height;
    scene.lights.constant = 0.3;
    scene.lights.sources = {DiscLight{{0, 0, 1}, 0, 0.6, {2.0}}};
    scene.settings.samples = samples;
    return scene;
}

constexpr int k_levels = 16;

Scene spheres(int pixels) {
    Scene scene;
    scene.objects = {{PlaneShape{{0, 0, -1}, {0, 0, 1}}, MirrorMaterial{{0.5}}},
                     {SphereShape{{-3, 0, 0}, 1}, MirrorMaterial{{0.8}}},
                     {SphereShape{{0, -0.5, 0}, 1}, DielectricMaterial{1.5, {0.0}}},
                     {SphereShape{{3, 0, 0}, 1}, DielectricMaterial{1.5, {0.5}}},
                     {SphereShape{{3, 4, 1}, 0.8}, EmitterMaterial{{0.9}}},
                     {DiscShape{{-3, 3, 2}, {0, -1, 0}, 1}, EmitterMaterial{{0.7}}}};
    scene.camera.position = {0, -11, 5};
    scene.camera.look_at = {0, 0, 0};
    scene.camera.up = {0, 0, 1};
    scene.camera.fov = 0.6;
    scene.camera.width = scene.camera.height = pixels;
    scene.lights.constant = 0.1;
    scene.lights.sources = {HemisphereLight{glm::normalize(Vec3{0.2, 0.1, 1}), {0.3}},
                            CosinePowerLight{glm::normalize(Vec3{0.5, -0.5, 0.7}), 4, {0.4}}};
    scene.settings.samples = 1;
    // Number of levels: POV-Ray follows every branch of glass's ray tree.
    scene.settings.depth = k_levels - 1;
    scene.settings.wavelengths_nm = {589.3};
    scene.settings.effects_auto = false;
    scene.settings.effects.fill(false);
    return scene;
}

// The ray through the middle of each pixel, with many seeds.
void beside_povray() {
    constexpr int k_pixels = 200, k_seeds = 1000;
    Scene scene = spheres(k_pixels);
    const Picture theirs = PovrayFolder().draw(scene, "-A", 1).picture;
    std::vector<double> sum(theirs.rgb.size()), halves_apart(sum.size());
    for (int seed = 1; seed <= k_seeds; ++seed) {
        scene.settings.seed = static_cast<std::uint64_t>(seed);
        const Picture ours = render(scene).picture;
        for (std::size_t i = 0; i < sum.size(); ++i) {
            const double part = static_cast<double>(ours.rgb[i]) / k_seeds;
            sum[i] += part;
            halves_apart[i] += seed % 2 == 0 ? part : -part;
        }
    }
    double squares = 0, inside = 0, mean = 0, noise = 0;
    int over = 0;
    for (std::size_t i = 0; i < sum.size(); ++i) {
        const double off = sum[i] - static_cast<double>(theirs.rgb[i]);
        squares += off * off;
        noise += halves_apart[i] * halves_apart[i];
        mean += sum[i];
        if (std::abs(off) > 0.02) {
            ++over;
        } else {
            inside += off * off;
        }
    }
    const auto count = static_cast<double>(sum.size());
    fmt::print(
        "spheres and a disc on a mirror beside POV-Ray, {0} x {0}, the mean of {1} seeds: mean "
        "{2:.4f}, "
        "RMSE {3:.2e}; without the {4:.2f} % of the pixels that differ by over 0.02 {5:.2e}; noise "
        "of the mean {6:.2e}\n",
        k_pixels, k_seeds, mean / count, std::sqrt(squares / count), 100 * over / count,
        std::sqrt(inside / count), std::sqrt(noise / count));
}

int run() {
    for (const auto& [width, height, samples] :
         {std::array{400, 300, 16}, {400, 300, 64}, {800, 600, 64}}) {
        const Scene scene = ring(width, height, samples);
        RenderResult result;
        const Clocks took = quickest([&] { result = render(scene); }, 1, 0);
        fmt::print(
            "ring with a diamond, {} x {}, {} samples: {:.1f} s CPU, standard error {:.4f}\n",
            width, height, samples, took.cpu, result.stats.standard_error);
    }
    if (povray_is_installed()) {
        beside_povray();
    } else {
        fmt::print("POV-Ray is not installed: nothing to hold pictures against\n");
    }
    return 0;
}

}  // namespace

int main() {
    try {
        return run();
    } catch (const std::exception& error) {
        std::cerr << "bench_objects: " << error.what() << "\n";
        return 2;
    }
}
