#include "tests/render/plan_scenes.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "render/scene/light_presets.h"
#include "stone/cuts/cuts.h"
#include "stone/numbers/units.h"
#include "tests/render/bench_scenes.h"

namespace culet {

namespace {

PlaneLight window(const Vec3& point, double half_width, double half_height) {
    const Vec3 normal = glm::normalize(-point);
    const Vec3 u = glm::normalize(glm::cross(Vec3{0, 0, 1}, normal));
    const Vec3 v = glm::cross(normal, u);
    return {point, normal, half_width * u, half_height * v, {2.5}};
}

Lights two_windows(double size) {
    Lights lights;
    lights.constant = 0.05;
    lights.sources.push_back(window(size * Vec3{12, 3, 12}, 3 * size, 5 * size));
    lights.sources.push_back(window(size * Vec3{-9, -7, 14}, 2 * size, 3 * size));
    return lights;
}

// A sun of its true size and a sky: the hardest case.
Lights bare_sun() {
    const Vec3 up{0, 0, 1};
    Lights lights;
    lights.sources.push_back(HemisphereLight{up, {Rgb{0.45, 0.5, 0.6}}});
    lights.sources.push_back(CosinePowerLight{up, 2, {Rgb{0.25, 0.4, 0.8}}});
    lights.sources.push_back(
        DiscLight{glm::normalize(Vec3{1, 0.4, 1.1}), 0, radians(0.27), {Rgb{9000, 8600, 7900}}});
    lights.constant = 0.08;
    return lights;
}

// "lightbox" and "daylight" are those of culet's measurements, not today's presets.
Lights light_named(const std::string& name, double size) {
    if (name == "smooth") return smooth_lights(3);
    if (name == "lightbox") return two_windows(size);
    if (name == "daylight") return bare_sun();
    if (name == "lamp") {
        Lights lights;
        lights.constant = 0.2;
        lights.sources.push_back(
            DiscLight{glm::normalize(Vec3{0.4, 0.2, 1}), 0, 0.35, {std::string("A")}});
        return lights;
    }
    return *light_preset(name);
}

}  // namespace

PlanScene plan_scene_of(const std::string& material, const std::string& cut,
                        const std::string& light, int pixels) {
    PlanScene made;
    made.name = material + ", " + cut + ", " + light;
    Scene& scene = made.scene;
    scene.stone.name = cut;
    scene.stone.solid = make_cut(cut);
    scene.stone.material = catalogue_material(material);
    // The optic axis is neither along the view nor across it.
    const Vec3 axis = glm::normalize(Vec3{0.5, 0.3, 0.8}),
               across = glm::normalize(glm::cross(axis, Vec3{0, 0, 1}));
    scene.stone.crystal.axes = {axis, across, glm::cross(axis, across)};
    scene.camera = bench_camera(scene.stone.solid, 6, bench_view(), pixels);
    scene.lights = light_named(light, diameter(scene.stone.solid));
    return made;
}

std::vector<PlanScene> plan_scenes(int pixels) {
    const std::vector<std::string> materials{"diamond",
                                             "corundum",
                                             "cubic_zirconia",
                                             "zircon_high",
                                             "garnet_almandine",
                                             "tourmaline_dravite",
                                             "glass_bk7",
                                             "peridot",
                                             "spinel",
                                             "ruby_pale",
                                             "fluorite",
                                             "quartz",
                                             "garnet_andradite",
                                             "andalusite",
                                             "yag",
                                             "topaz_blue",
                                             "glass_sf57",
                                             "emerald",
                                             "strontium_titanate",
                                             "tanzanite"};
    const std::vector<std::string> cuts{"round-brilliant", "step", "oval", "princess", "trillion"};
    const std::vector<std::string> lights{"lightbox", "smooth", "daylight",
                                          "aset",     "lamp",   "arrows"};
    std::vector<PlanScene> scenes;
    for (std::size_t i = 0; i < 60; ++i) {
        // Steps without common factors: every material meets three cuts and three lights.
        const std::size_t turn = i / materials.size();
        scenes.push_back(plan_scene_of(materials[i % materials.size()],
                                       cuts[(i + turn) % cuts.size()],
                                       lights[(i + 2 * turn) % lights.size()], pixels));
    }
    return scenes;
}

}  // namespace culet
