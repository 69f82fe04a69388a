#include "bench/studies/scenes.h"

#include <cmath>

#include "render/colour/colour.h"
#include "render/scene/scene_io.h"
#include "render/scene/setting_scene.h"
#include "render/scene/stone_scene.h"
#include "stone/mesh/mesh_io.h"
#include "stone/text/errors.h"
#include "stone/text/output_file.h"
#include "tests/render/bench_scenes.h"
#include "tests/scratch_folder.h"

namespace culet {

Scene face_up(const Solid& solid, const Material& material, const std::string& light, int pixels) {
    Stone stone;
    stone.solid = solid;
    stone.material = material;
    StoneScene choices;
    choices.light = light;
    Scene scene = scene_around(stone, {}, choices);
    scene.camera.width = scene.camera.height = pixels;
    scene.settings.check = Check::none;
    return scene;
}

Scene tree_scene(const Solid& solid, const Material& material, double diameters, int pixels,
                 int depth) {
    Scene scene = base_scene(pixels);
    scene.stone.solid = solid;
    scene.stone.material = material;
    scene.camera = bench_camera(solid, diameters, bench_view(), pixels);
    scene.settings.depth = depth;
    return scene;
}

Scene in_ring(const Solid& solid, const std::string& material, int pixels) {
    const test::ScratchFolder folder;  // a scene names its meshes by files
    SettingOptions options;
    options.prongs = 4;
    const Setting setting = make_setting(solid, {0, 0, 1}, options);
    write_solid(solid, folder / "stone.obj");
    write_surface(mesh_of(setting), folder / "ring.obj");
    SettingScene files;
    files.scene = folder / "scene.toml";
    files.stone = folder / "stone.obj";
    files.material = material;
    files.setting = folder / "ring.obj";
    files.metal = metal_named("gold");
    write_text(files.scene, setting_scene(files, setting));
    Scene scene = read_scene(files.scene);
    scene.camera.width = scene.camera.height = pixels;
    scene.settings.check = Check::none;
    return scene;
}

double mean_difference(const Picture& picture, const Picture& truth) {
    check(picture.rgb.size() == truth.rgb.size(), "pictures are of one size");
    double sum = 0, whole = 0;
    for (std::size_t i = 0; i < truth.pixels(); ++i) {
        if (!(truth.coverage[i] > 0)) continue;
        const double there = luminance(&truth.rgb[3 * i]);
        sum += std::abs(luminance(&picture.rgb[3 * i]) - there);
        whole += there;
    }
    return sum / whole;
}

Picture difference_picture(const Picture& picture, const Picture& truth) {
    Picture shown = truth;
    for (std::size_t i = 0; i < truth.pixels(); ++i) {
        const double apart =
            std::abs(luminance(&picture.rgb[3 * i]) - luminance(&truth.rgb[3 * i]));
        for (std::size_t c = 0; c < 3; ++c) shown.rgb[3 * i + c] = static_cast<float>(apart);
    }
    return shown;
}

Solid stone_of_facets(int facets) {
    check(facets == 93 || facets == 115, "93 facets or 115");
    const int first = facets == 93 ? 8 : 9, other = facets == 93 ? 12 : 15;
    return ringed_stone({{first, 65},
                         {other, 45},
                         {other, 28},
                         {other, 0},
                         {other, -40},
                         {other, -46},
                         {other, -53},
                         {other, -62}},
                        0.35, 0.85);
}

}  // namespace culet
