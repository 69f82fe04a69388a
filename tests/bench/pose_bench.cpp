// Registration on simulated photographs: how near the camera found comes to the camera that took
// the picture, and whether the uncertainty given is true.
//
//   build/bench_pose --seeds 100 --size 400

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numbers>

#include "compare/pose/find_pose.h"
#include "compare/pose/stone_view.h"
#include "render/render.h"
#include "stone/cuts/cuts.h"
#include "stone/stone.h"
#include "stone/units.h"
#include "tests/bench/cpu_time.h"
#include "tests/compare/simulated_photo.h"

namespace {

using namespace culet;

struct Settings {
    int seeds = 20, first = 1, size = 400, threads = 0;
    double facet_deg = 0.2, start_deg = 30, start_scale = 0.2, tilt_deg = 30, limit_deg = 0.1,
           limit_px = 0.1;
    std::string cut, light, folder;
    bool mirrored = false, with_mask = false, verbose = false;
};

struct Cut {
    std::string name, material;
    int fold = 1;  // turns about z that leave the model as it is
};
const std::vector<Cut> k_cuts{{"round-brilliant", "diamond", 8},
                              {"step", "spinel", 2},
                              {"oval", "diamond", 2},
                              {"pear", "yag", 1},
                              {"trillion", "diamond", 3}};
const std::vector<std::string> k_lights{"windows", "dome", "ring", "overcast"};

struct Trial {
    bool usable = false, mirrored_wrong = false;
    double angle = 0, shift = 0, scale = 0, sigma_angle = 0, sigma_shift = 0, seconds = 0;
    std::array<double, 3> normalized{};
    std::string label, trouble;
};

/// From the truth to what was found, by the least turn of those that differ by the model's
/// symmetry.
Vec3 turn_between(const StoneView& truth, const StoneView& found, int fold) {
    Vec3 best(1e9);
    for (int k = 0; k < fold; ++k) {
        const glm::dmat3 symmetric = rotation_by({0, 0, 2 * std::numbers::pi * k / fold});
        const glm::dmat3 turn = found.turn * symmetric * glm::transpose(truth.turn);
        const double angle = angle_of(turn);
        const Vec3 axis(turn[1][2] - turn[2][1], turn[2][0] - turn[0][2], turn[0][1] - turn[1][0]);
        const double length = glm::length(axis);
        const Vec3 w = length > 0 ? angle * axis / length : Vec3(0);
        if (glm::length(w) < glm::length(best)) best = w;
    }
    return best;
}

Trial one_trial(const Settings& settings, int seed) {
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
    const Solid model = make_cut(cut.name);
    synthetic::Standpoint place;
    place.tilt = radians(uniform(0, settings.tilt_deg));
    place.azimuth = uniform(0, 2 * std::numbers::pi);
    place.roll = uniform(0, 2 * std::numbers::pi);
    place.share = uniform(0.65, 0.85);
    place.diameters = seed % 3 == 0 ? 0 : uniform(5, 30);
    place.off_x = uniform(-0.05, 0.05);
    place.off_y = uniform(-0.05, 0.05);
    place.size = settings.size;
    Scene scene;
    scene.stone.solid = synthetic::tilted_facets(model, radians(settings.facet_deg), random);
    scene.stone.material = catalogue_material(cut.material);
    scene.camera = synthetic::camera_at(model, place);
    scene.lights = synthetic::named_lights(light);
    scene.settings.engine = "beams";
    scene.settings.samples = 16;
    scene.settings.tolerance = 0.03;
    scene.settings.threads = settings.threads;
    const RenderResult drawn = render(scene);
    synthetic::CameraFaults faults;
    Photo photo = synthetic::photographed(drawn.picture, faults, random);
    const Camera start =
        synthetic::disturbed(scene.camera, model, radians(uniform(0, settings.start_deg)),
                             1 + uniform(-settings.start_scale, settings.start_scale), random);
    PoseOptions options;
    options.threads = settings.threads;
    options.limits.angle = radians(settings.limit_deg);
    options.limits.shift_px = settings.limit_px;
    if (settings.with_mask) options.mask = drawn.picture.coverage;
    const double before = clocks().cpu;
    const FoundPose pose = find_pose(photo, model, start, options);
    Trial trial;
    trial.seconds = clocks().cpu - before;
    trial.usable = pose.usable();
    trial.trouble = pose.trouble;
    trial.label = fmt::format("{:4d} {:15} {:8} tilt {:4.1f} {:>4.1f} D", seed, cut.name, light,
                              degrees(place.tilt), place.diameters);
    const Vec3 middle = centroid(model);
    const StoneView truth = stone_view(scene.camera, middle),
                    found = stone_view(pose.camera, middle);
    const Vec3 off = turn_between(truth, found, cut.fold);
    trial.mirrored_wrong = pose.mirrored;
    trial.angle = degrees(glm::length(off));
    trial.shift = std::hypot(found.at.x - truth.at.x, found.at.y - truth.at.y);
    trial.scale = found.scale / truth.scale - 1;
    trial.sigma_angle = degrees(pose.sigmas.angle);
    trial.sigma_shift = std::hypot(pose.sigmas.shift_px[0], pose.sigmas.shift_px[1]);
    for (int k = 0; k < 3; ++k)
        trial.normalized[static_cast<std::size_t>(k)] =
            off[k] / pose.sigmas.turn[static_cast<std::size_t>(k)];
    if (settings.verbose) {
        std::setvbuf(stdout, nullptr, _IOLBF, 0);
        fmt::print(
            "{}  off {:6.3f} deg ({:.3f}) {:5.2f} px ({:.2f}) scale {:+.4f}  outline {:.2f} crown "
            "{:.2f} px met {:.2f}/{:.2f} z {:4.1f} facets {:.3f} {:.4f}  {:.1f} s {}\n",
            trial.label, trial.angle, trial.sigma_angle, trial.shift, trial.sigma_shift,
            trial.scale, pose.outline_px, pose.crown_px, pose.crown_support, pose.chance_support,
            pose.support_z, degrees(pose.facet_error), pose.facet_offset, trial.seconds,
            pose.mirrored ? "MIRRORED " : "" + pose.trouble);
        for (const TriedPose& other : pose.others)
            fmt::print("        other {:6.2f} deg lead {:6.1f} {}{}\n", degrees(other.turn),
                       other.lead, other.symmetric ? "symmetric" : "",
                       other.mirrored ? " mirrored" : "");
    }
    if (!settings.folder.empty()) {
        std::ofstream file(settings.folder + fmt::format("/seed-{}.png", seed), std::ios::binary);
        const std::string bytes = pose_overlay(photo, model, pose);
        file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    }
    return trial;
}

}  // namespace

int main(int argc, char** argv) {
    Settings settings;
    CLI::App program("registration on simulated photographs");
    program.add_option("--seeds", settings.seeds);
    program.add_option("--first", settings.first);
    program.add_option("--size", settings.size);
    program.add_option("--facet-deg", settings.facet_deg);
    program.add_option("--start-deg", settings.start_deg);
    program.add_option("--tilt-deg", settings.tilt_deg);
    program.add_option("--limit-deg", settings.limit_deg);
    program.add_option("--limit-px", settings.limit_px);
    program.add_option("--cut", settings.cut);
    program.add_option("--light", settings.light);
    program.add_option("--threads", settings.threads);
    program.add_option("--overlays", settings.folder);
    program.add_flag("--mask", settings.with_mask);
    program.add_flag("-v", settings.verbose);
    CLI11_PARSE(program, argc, argv);
    std::vector<Trial> trials;
    for (int seed = settings.first; seed < settings.first + settings.seeds; ++seed)
        trials.push_back(one_trial(settings, seed));
    int good = 0, refused = 0, wrong = 0, refused_good = 0;
    double squares = 0, seconds = 0;
    std::vector<double> angles, shifts;
    for (const Trial& trial : trials) {
        seconds += trial.seconds;
        const bool within = trial.angle <= 0.1 && trial.shift <= 0.1 && !trial.mirrored_wrong;
        if (!trial.usable) {
            ++refused;
            if (within) ++refused_good;
            continue;
        }
        (within ? good : wrong) += 1;
        angles.push_back(trial.angle);
        shifts.push_back(trial.shift);
        for (double n : trial.normalized) squares += n * n / 3;
    }
    std::sort(angles.begin(), angles.end());
    std::sort(shifts.begin(), shifts.end());
    const auto at = [](const std::vector<double>& v, double share) {
        return v.empty() ? NAN
                         : v[static_cast<std::size_t>(share * static_cast<double>(v.size() - 1))];
    };
    fmt::print(
        "{} trials: {} within 0.1 degree and 0.1 px, {} refused ({} of them within), {} others\n",
        trials.size(), good, refused, refused_good, wrong);
    fmt::print(
        "angle: median {:.3f}, 90 % {:.3f}, worst {:.3f} degrees; shift: median {:.3f}, 90 % "
        "{:.3f}, worst {:.3f} px\n",
        at(angles, 0.5), at(angles, 0.9), at(angles, 1), at(shifts, 0.5), at(shifts, 0.9),
        at(shifts, 1));
    fmt::print("errors over their sigmas: {:.2f} (rms); {:.2f} s of processor time each\n",
               std::sqrt(squares / std::max<double>(1, static_cast<double>(angles.size()))),
               seconds / static_cast<double>(trials.size()));
    return 0;
}
