#include "tests/bench/plan_scenes.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "render/light_presets.h"
#include "stone/cuts/cuts.h"
#include "tests/bench/bench_scenes.h"

namespace culet {

namespace {

Lights light_named(const std::string& name, double size) {
    if (name == "smooth") return smooth_lights(3);
    if (name == "lamp") {
        // One tungsten lamp over a grey room.
        Lights lights;
        lights.constant = 0.2;
        lights.caps.push_back({glm::normalize(Vec3{0.4, 0.2, 1}), 0, 0.35, {std::string("A")}});
        return lights;
    }
    return *light_preset(name, size);
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
    // The optic axis neither along the view nor across it.
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
