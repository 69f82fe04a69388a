// Registers photographs by POV-Ray, a camera that shares only the scene with culet, and compares
// the found camera with POV-Ray's. The photographs show cuts and, where the scan is available, a
// real diamond; under a real panorama where one is installed (package blender-data).
//
//   sh bench/cameras/run.sh

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numbers>
#include <sstream>

#include "compare/pose/find_pose.h"
#include "compare/pose/same_look.h"
#include "compare/pose/stone_view.h"
#include "render/export/povray.h"
#include "render/image/image_io.h"
#include "render/render.h"
#include "stone/cuts/cuts.h"
#include "stone/numbers/units.h"
#include "stone/text/errors.h"
#include "stone/text/output_file.h"
#include "tests/compare/simulated_photo.h"
#include "tests/scanned_solid.h"

namespace {

using namespace culet;
namespace fs = std::filesystem;

const fs::path k_panoramas = "/usr/share/blender/datafiles/studiolights/world";

struct Sitter {
    std::string name;
    Solid model;
};

/// POV-Ray's picture in linear light; `sky`: a panorama around the scene.
Picture by_povray(const Scene& scene, const fs::path& sky, const fs::path& folder) {
    std::string text = povray_scene(scene).text;
    if (!sky.empty()) {
        text += fmt::format(
            "sky_sphere {{ pigment {{ image_map {{ exr \"{}\" map_type 1 interpolate 2 }} }} }}\n",
            sky.string());
    }
    const std::string in = (folder / "scene.pov").string(), out = (folder / "picture.png").string();
    write_text(in, text);
    const std::string command = fmt::format(
        "povray '+I{}' '+O{}' +W{} +H{} +AM1 +A0.0 -J +R4 -D -V +FN16 File_Gamma=sRGB >'{}' 2>&1",
        in, out, scene.camera.width, scene.camera.height, (folder / "messages.txt").string());
    if (std::system(command.c_str()) != 0)
        throw InputError("POV-Ray failed:\n" + read_text(folder / "messages.txt"));
    return read_picture(out).picture;
}

double least_turn(const WireSolid& model, const StoneView& truth, const StoneView& found) {
    double least = 10;
    for (const glm::dmat3& symmetry : symmetries_of(model)) {
        if (glm::determinant(symmetry) < 0) continue;
        least = std::min(least, angle_of(found.turn * symmetry * glm::transpose(truth.turn)));
    }
    return least;
}

}  // namespace

int main(int argc, char** argv) {
    std::string folder = "povray-photographs", scan;
    int size = 500, seeds = 2;
    double facet_deg = 0.2;
    CLI::App program("registration of POV-Ray's photographs");
    program.add_option("-o", folder);
    program.add_option("--size", size);
    program.add_option("--seeds", seeds);
    program.add_option("--facet-deg", facet_deg);
    program.add_option("--scan", scan, "a scanned stone (polyhedron.dat), too");
    CLI11_PARSE(program, argc, argv);
    fs::create_directories(folder);
    std::vector<Sitter> sitters;
    for (const char* cut : {"round-brilliant", "step", "oval"})
        sitters.push_back({cut, make_cut(cut)});
    if (!scan.empty()) sitters.push_back({"scanned-stone", scanned_solid(scan)});
    std::vector<fs::path> skies{""};
    for (const char* sky : {"studio.exr", "interior.exr"})
        if (fs::exists(k_panoramas / sky)) skies.push_back(k_panoramas / sky);
    int wrong = 0;
    for (const Sitter& sitter : sitters) {
        for (const fs::path& sky : skies) {
            for (int seed = 1; seed <= seeds; ++seed) {
                std::mt19937_64 random(static_cast<std::uint64_t>(seed));
                const auto uniform = [&](double low, double high) {
                    return std::uniform_real_distribution<double>(low, high)(random);
                };
                synthetic::Standpoint place;
                place.tilt = radians(uniform(2, 28));
                place.azimuth = uniform(0, 2 * std::numbers::pi);
                place.roll = uniform(0, 2 * std::numbers::pi);
                place.diameters = uniform(6, 25);
                place.size = size;
                Scene scene;
                scene.stone.solid =
                    synthetic::tilted_facets(sitter.model, radians(facet_deg), random);
                scene.stone.material = catalogue_material("diamond");
                scene.camera = synthetic::camera_at(sitter.model, place);
                scene.settings.wavelengths_nm = {589.3};
                scene.settings.depth = 10;
                // Without a panorama, a room of caps with a floor of one tone.
                if (sky.empty()) scene.lights = synthetic::named_lights("ring");
                const Picture picture = by_povray(scene, sky, folder);
                Photo photo = synthetic::photographed(picture, {}, random);
                PoseOptions options;
                options.limits.angle = radians(1);
                options.limits.shift_px = 1;
                if (!sky.empty()) {
                    // As a person would paint the mask: a panorama behind the stone is not a plain
                    // background.
                    Scene plain = scene;
                    plain.lights = synthetic::named_lights("ring");
                    plain.settings.engine = "preview";
                    photo.mask = render(plain).picture.coverage;
                }
                const Camera start = synthetic::disturbed(
                    scene.camera, sitter.model, radians(uniform(0, 30)), uniform(0.8, 1.2), random);
                const FoundPose pose = find_pose(photo, sitter.model, start, options);
                const WireSolid wire(sitter.model);
                const StoneView truth = stone_view(scene.camera, wire.middle);
                const StoneView found = stone_view(pose.camera, wire.middle);
                const double angle = degrees(least_turn(wire, truth, found));
                const double shift = std::hypot(found.at.x - truth.at.x, found.at.y - truth.at.y);
                const bool promised = angle <= degrees(pose.sigmas.angle_99) &&
                                      shift <= pose.sigmas.shift_99_px && !pose.mirrored;
                if (pose.usable() && !promised) ++wrong;
                const std::string name = fmt::format(
                    "{}-{}-{}", sitter.name, sky.empty() ? "ring" : sky.stem().string(), seed);
                fmt::print(
                    "{:32} off {:.3f} degrees (99 %: {:.3f}), {:.3f} px ({:.3f}), z {:.1f} {}\n",
                    name, angle, degrees(pose.sigmas.angle_99), shift, pose.sigmas.shift_99_px,
                    pose.support_z, pose.trouble);
                write_text(fs::path(folder) / (name + ".png"),
                           pose_overlay(photo, sitter.model, pose));
            }
        }
    }
    fmt::print("{} beyond what was promised and not refused\n", wrong);
    return wrong == 0 ? 0 : 1;
}
