#include "tests/render/bench_scenes.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "stone/solid/perpendicular.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

Solid class_angles_brilliant() {
    return read_solid(CULET_SOURCE_DIR "/tests/stone/designs/srb_class_angles.asc").solid;
}

Solid without_girdle(const Solid& solid) {
    std::vector<NamedPlane> planes;
    for (const Facet& facet : solid.facets) {
        if (std::abs(facet.plane.normal.z) > 1e-9) planes.push_back({facet.name, facet.plane});
    }
    const Solid whole = intersect_half_spaces(planes).solid;
    return contract_near_meets(whole, 1e-6 * diameter(whole)).solid;
}

}  // namespace

Solid ringed_stone(const std::vector<Ring>& rings, double crown, double pavilion) {
    std::vector<NamedPlane> planes{{"table", {{0, 0, 1}, crown}}};
    bool turned = false;
    for (const Ring& ring : rings) {
        const double latitude = ring.latitude_deg * std::numbers::pi / 180,
                     height = latitude > 0 ? crown : pavilion;
        for (int i = 0; i < ring.facets; ++i) {
            const double azimuth = 2 * std::numbers::pi * (i + (turned ? 0.5 : 0)) / ring.facets;
            const Vec3 n{std::cos(latitude) * std::cos(azimuth),
                         std::cos(latitude) * std::sin(azimuth), std::sin(latitude)};
            // The tangent plane of x^2 + y^2 + (z / h)^2 = 1.
            planes.push_back({"facet", {n, std::hypot(n.x, n.y, height * n.z)}});
        }
        turned = !turned;
    }
    Solid solid = intersect_half_spaces(planes).solid;
    check(solid.facets.size() == planes.size(), "every tangent plane holds a facet");
    return solid;
}

std::vector<BenchStone> bench_stones() {
    const Solid brilliant = class_angles_brilliant();
    const std::vector<Ring> few{{8, 65},   {16, 45},  {16, 28},  {16, 0},
                                {16, -40}, {16, -45}, {16, -52}, {16, -62}};
    const std::vector<Ring> many{{15, 70},  {24, 52},  {24, 40},  {24, 28},  {24, 0},
                                 {24, -36}, {24, -40}, {24, -44}, {24, -48}, {24, -52},
                                 {24, -56}, {24, -61}, {24, -68}};
    return {{"57 facets", without_girdle(brilliant)},
            {"73 facets", brilliant},
            {"121 facets", ringed_stone(few, 0.35, 0.85)},
            {"304 facets", ringed_stone(many, 0.35, 0.85)}};
}

Camera bench_camera(const Solid& solid, double diameters, const Vec3& towards_eye, int pixels) {
    Vec3 low(1e300), high(-1e300);
    for (const Vec3& corner : solid.vertices) {
        low = glm::min(low, corner);
        high = glm::max(high, corner);
    }
    Camera camera;
    camera.look_at = 0.5 * (low + high);
    camera.position = camera.look_at + diameters * diameter(solid) * glm::normalize(towards_eye);
    camera.fov = 2 * std::asin(0.5 / diameters);
    camera.width = camera.height = pixels;
    return camera;
}

Vec3 bench_view() {
    const double tilt = 20 * std::numbers::pi / 180;
    return {std::sin(tilt) * std::cos(0.3), std::sin(tilt) * std::sin(0.3), std::cos(tilt)};
}

Vec3 random_view(std::mt19937_64& random) {
    std::normal_distribution<double> normal;
    const double x = normal(random), y = normal(random), z = normal(random);
    return glm::normalize(Vec3{x, y, z});
}

Lights smooth_lights(double peak) {
    Lights lights;
    const double scale = peak / 5;
    lights.constant = 0.1 * scale;
    lights.sources.push_back(
        CosinePowerLight{glm::normalize(Vec3{0.3, 0.2, 1}), 16, {4.7 * scale}});
    lights.sources.push_back(
        CosinePowerLight{glm::normalize(Vec3{-1, 0.4, 0.5}), 8, {2.0 * scale}});
    lights.sources.push_back(
        CosinePowerLight{glm::normalize(Vec3{0.5, -1, 0.3}), 4, {1.0 * scale}});
    return lights;
}

Lights near_lights(double diameter) {
    Lights lights;
    lights.constant = 0.05;
    // Beyond the camera or far to its side, so that no plane is seen from behind.
    const auto panel = [&](const Vec3& towards, double away, double half, double radiance) {
        const Vec3 way = glm::normalize(towards), u = half * diameter * perpendicular_to(way);
        lights.sources.push_back(
            PlaneLight{away * diameter * way, -way, u, glm::cross(way, u), {radiance}});
    };
    panel({0.5, 0.3, 1}, 8, 3.2, 0.9);
    panel({-1, 0.5, 0.25}, 2.5, 0.7, 0.6);
    panel({0.3, -1, 0.3}, 2.5, 0.7, 0.4);
    lights.sources.push_back(SphereLight{diameter * Vec3{-0.9, -1.2, 2.2}, 0.25 * diameter, {0.9}});
    lights.sources.push_back(SphereLight{diameter * Vec3{1.6, -0.6, 1.4}, 0.2 * diameter, {0.7}});
    return lights;
}

Scene base_scene(int pixels) {
    Scene scene;
    scene.stone.solid = class_angles_brilliant();
    scene.stone.material = catalogue_material("diamond");
    scene.camera = bench_camera(scene.stone.solid, 6, bench_view(), pixels);
    scene.lights = smooth_lights();
    scene.settings.depth = 8;
    scene.settings.tolerance = 0;
    scene.settings.wavelengths_nm = {589.3};
    set_polarised(scene, false);
    return scene;
}

void set_polarised(Scene& scene, bool polarised) {
    RenderSettings& settings = scene.settings;
    settings.effects_auto = false;
    settings.effects.fill(true);
    settings.effects[static_cast<std::size_t>(Effects::polarization)] = polarised;
}

}  // namespace culet
