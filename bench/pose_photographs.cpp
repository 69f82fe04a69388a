#include "bench/pose_photographs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <map>
#include <numbers>

#include "render/render.h"
#include "stone/cuts/cuts.h"
#include "stone/numbers/units.h"
#include "stone/stone.h"
#include "tests/compare/simulated_photo.h"

namespace culet {

namespace {

struct Cut {
    std::string name, material;
    int symmetry_order = 1;                             // order of the model's symmetry about z
    std::string other;                                  // a cut with about the same outline
    std::map<std::string, double> angles, no_angles{};  // other proportions
};
const std::vector<Cut> k_cuts{
    {"round-brilliant", "diamond", 8, "cushion", {{"table", 66}, {"crown-angle", 30}}},
    {"step", "tourmaline_elbaite", 2, "oval", {{"table", 70}, {"crown-angle", 30}}},
    {"oval", "spinel", 2, "step", {{"table", 64}, {"crown-angle", 40}}},
    {"pear", "yag", 1, "marquise", {{"table", 64}, {"crown-angle", 40}}},
    {"trillion", "diamond", 3, "pear", {{"table", 66}, {"crown-angle", 38}}},
    {"cushion", "garnet_pyrope", 2, "round-brilliant", {{"table", 66}, {"crown-angle", 38}}},
    {"princess", "cubic_zirconia", 4, "step", {{"table", 78}, {"crown-height", 8}}},
    {"marquise", "glass_sf10", 2, "oval", {{"table", 64}, {"crown-angle", 40}}}};
const std::vector<std::string> k_lights{"windows", "dome", "ring", "overcast"};

/// Like facets in a dark room: a plate of grey patches with the stone's outline.
void paint_patches(Picture& picture, std::mt19937_64& random) {
    std::vector<std::array<double, 3>> lines;
    std::uniform_real_distribution<double> uniform(0, 1);
    for (int i = 0; i < 14; ++i) {
        const double angle = 2 * std::numbers::pi * uniform(random);
        lines.push_back({std::cos(angle), std::sin(angle), 0.35 * picture.width * uniform(random)});
    }
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            const auto p = static_cast<std::size_t>(y * picture.width + x);
            if (picture.coverage[p] < 0.5f) continue;
            unsigned patch = 1;
            for (const auto& line : lines) {
                const double across = line[0] * (x - 0.5 * picture.width) +
                                      line[1] * (y - 0.5 * picture.height) - line[2];
                patch = patch * 31 + (across > 0 ? 7 : 3);
            }
            for (std::size_t c = 0; c < 3; ++c)
                picture.rgb[3 * p + c] = 0.1f + 0.02f * static_cast<float>(patch % 40);
        }
    }
}

/// Crops to the stone and a margin that differs on each side.
void crop(PosePhotograph& made, const Picture& picture, std::mt19937_64& random) {
    int left = picture.width, right = 0, top = picture.height, bottom = 0;
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            if (picture.coverage[static_cast<std::size_t>(y * picture.width + x)] < 0.5f) continue;
            left = std::min(left, x);
            right = std::max(right, x + 1);
            top = std::min(top, y);
            bottom = std::max(bottom, y + 1);
        }
    }
    std::uniform_real_distribution<double> share(0.15, 0.9);
    left = static_cast<int>(left * share(random));
    top = static_cast<int>(top * share(random));
    right += static_cast<int>((picture.width - right) * share(random));
    bottom += static_cast<int>((picture.height - bottom) * share(random));
    made.photo = synthetic::cropped(made.photo, left, top, right - left, bottom - top);
    made.truth.at = {made.truth.at.x - left, made.truth.at.y - top};
    made.truth.sight = {made.truth.sight.x - left, made.truth.sight.y - top};
    made.coverage.clear();
}

void mirror(PosePhotograph& made) {
    made.photo = synthetic::mirrored(made.photo);
    made.coverage.clear();
}

}  // namespace

const std::vector<std::pair<std::string, Fault>>& faults() {
    static const std::vector<std::pair<std::string, Fault>> k_faults{
        {"none", Fault::none},
        {"other-cut", Fault::other_cut},
        {"other-angles", Fault::other_angles},
        {"other-side", Fault::other_side},
        {"mirrored", Fault::mirrored},
        {"turned-start", Fault::turned_start},
        {"no-stone", Fault::no_stone}};
    return k_faults;
}

Vec3 turn_between(const StoneView& truth, const StoneView& found, int symmetry_order) {
    Vec3 best(1e9);
    for (int k = 0; k < symmetry_order; ++k) {
        const glm::dmat3 symmetric = rotation_by({0, 0, 2 * std::numbers::pi * k / symmetry_order});
        const glm::dmat3 turn = found.turn * symmetric * glm::transpose(truth.turn);
        const double angle = angle_of(turn);
        const Vec3 axis(turn[1][2] - turn[2][1], turn[2][0] - turn[0][2], turn[0][1] - turn[1][0]);
        const double length = glm::length(axis);
        const Vec3 w = length > 0 ? angle * axis / length : Vec3(0);
        if (glm::length(w) < glm::length(best)) best = w;
    }
    return best;
}

PosePhotograph pose_photograph(const PhotographSettings& settings, int seed, Fault fault) {
    std::mt19937_64 random(static_cast<std::uint64_t>(seed) * 7919);
    const auto uniform = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    const auto pick = static_cast<std::size_t>(seed);
    Cut cut = k_cuts[pick % k_cuts.size()];
    for (const Cut& known : k_cuts)
        if (known.name == settings.cut) cut = known;
    const std::string light = settings.light.empty()
                                  ? k_lights[(pick / k_cuts.size()) % k_lights.size()]
                                  : settings.light;
    PosePhotograph made;
    made.symmetry_order = cut.symmetry_order;
    made.model = make_cut(cut.name);
    Solid stone = made.model;
    const bool asymmetric = fault == Fault::mirrored || fault == Fault::turned_start;
    const double off_standard = asymmetric ? std::max(1.0, settings.off_standard_deg)
                                : (pick / k_cuts.size() + pick) % 2 == 0 ? settings.off_standard_deg
                                                                         : 0;
    if (off_standard > 0) {
        made.model = synthetic::tilted_facets(made.model, radians(off_standard), random);
        made.symmetry_order = 1;
    }
    stone = synthetic::tilted_facets(made.model, radians(settings.facet_deg), random);
    synthetic::Standpoint place;
    place.tilt = radians(uniform(0, settings.tilt_deg));
    place.azimuth = uniform(0, 2 * std::numbers::pi);
    place.roll = uniform(0, 2 * std::numbers::pi);
    place.share = uniform(0.65, 0.85);
    place.diameters = seed % 3 == 0 ? 0 : uniform(5, 30);
    place.off_x = uniform(-0.05, 0.05);
    place.off_y = uniform(-0.05, 0.05);
    place.size = settings.size;
    if (settings.least_stone_px > 0)
        place.size = static_cast<int>(uniform(settings.least_stone_px, settings.most_stone_px) /
                                      place.share);
    Scene scene;
    scene.stone.solid = stone;
    scene.stone.material = catalogue_material(cut.material);
    scene.camera = synthetic::camera_at(made.model, place);
    const Camera front = scene.camera;
    if (fault == Fault::other_side) {
        place.tilt = std::numbers::pi - place.tilt;
        scene.camera = synthetic::camera_at(made.model, place);
    }
    scene.lights = synthetic::named_lights(light);
    if (fault == Fault::other_side) {
        // The stone lies on its table: the crown's light falls on the pavilion.
        for (DiscLight& cap : lights_of_type<DiscLight>(scene.lights))
            cap.direction.z = -cap.direction.z;
        for (CosinePowerLight& lobe : lights_of_type<CosinePowerLight>(scene.lights))
            lobe.direction.z = -lobe.direction.z;
        for (HemisphereLight& half : lights_of_type<HemisphereLight>(scene.lights))
            half.direction.z = -half.direction.z;
    }
    scene.settings.engine = "beams";
    scene.settings.samples = 16;
    scene.settings.tolerance = 0.03;
    scene.settings.threads = settings.threads;
    Picture picture = render(scene).picture;
    if (fault == Fault::no_stone) paint_patches(picture, random);
    synthetic::CameraFaults camera;
    camera.blur_px = uniform(settings.least_blur, settings.most_blur);
    camera.full_well = settings.full_well;
    camera.jpeg_quality = settings.jpeg_quality;
    made.photo = synthetic::photographed(picture, camera, random);
    made.coverage = picture.coverage;
    made.truth = stone_view(scene.camera, centroid(made.model));
    Camera near = front;
    if (fault == Fault::turned_start) {
        StoneView turned = stone_view(near, centroid(made.model));
        const double step = 2 * std::numbers::pi / std::max(2, cut.symmetry_order);
        turned.turn = turned.turn * rotation_by({0, 0, step});
        near = camera_of(turned, near);
    }
    made.start =
        synthetic::disturbed(near, made.model, radians(uniform(0, settings.start_deg)),
                             1 + uniform(-settings.start_scale, settings.start_scale), random);
    if (settings.crop) crop(made, picture, random);
    if (fault == Fault::mirrored) mirror(made);
    if (fault == Fault::other_cut) made.model = make_cut(cut.other);
    if (fault == Fault::other_angles) made.model = make_cut(cut.name, cut.angles);
    made.label = fmt::format("{:4d} {:15} {:8} tilt {:4.1f} {:>4.1f} D", seed, cut.name, light,
                             degrees(place.tilt), place.diameters);
    return made;
}

}  // namespace culet
