// Registers simulated photographs: how accurate the found camera is, whether its stated uncertainty
// is right, and whether wrong photographs are refused.
//
//   build/bench_pose --seeds 100 --as-taken --stone-px 200 400
//   build/bench_pose --seeds 100 --as-taken --fault other-cut

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>

#include "bench/pose_photographs.h"
#include "compare/pose/find_pose.h"
#include "stone/numbers/units.h"
#include "tests/cpu_time.h"

namespace {

using namespace culet;

struct Settings {
    PhotographSettings photographs;
    int seeds = 20, first = 1;
    double limit_deg = 0, limit_px = 0;  // 0: the program's defaults
    std::string fault = "none", folder;
    std::array<double, 2> stone_px{0, 0};
    bool as_taken = false, with_mask = false, verbose = false;
};

struct Trial {
    FoundPose pose;
    double angle = 0, shift = 0, scale = 0, sigma_shift = 0, seconds = 0;
    bool usable = false, held = false, wrong = false;
    std::array<double, 3> normalized{};
};

// An accepted pose counts as wrong, not just unlucky, when it is off by more than this multiple of
// its stated 99 % bound, or by more degrees than this.
constexpr double k_wrong_times = 3, k_wrong_deg = 5;

void print(const Trial& trial, const std::string& label) {
    const FoundPose& pose = trial.pose;
    fmt::print(
        "{}  off {:6.3f} deg (99 % {:.3f}) {:5.2f} px ({:.2f}) scale {:+.4f}  outline {:.2f} crown "
        "{:.2f} px z {:4.1f} met {}/{} chance {:.2f} odds {:.1f} misfit {:.2f} by-edges "
        "{:.3f} by-groups {:.3f} facets {:.3f} {:.4f} D {:.0f}  {:.1f} s {} {}{}\n",
        label, trial.angle, degrees(pose.sigmas.angle_99), trial.shift, pose.sigmas.shift_99_px,
        trial.scale, pose.outline_px, pose.crown_px, pose.support_z, pose.evidence.met,
        pose.evidence.looked, pose.evidence.chance_share, pose.evidence.log_odds,
        pose.evidence.misfit, degrees(pose.angle_by_edges), degrees(pose.angle_by_groups),
        degrees(pose.facet_error), pose.facet_offset, pose.diameter_px, trial.seconds,
        trial.wrong     ? "WRONG"
        : !trial.usable ? "refused"
        : trial.held    ? "held"
                        : "missed",
        pose.mirrored ? "MIRRORED " : "", pose.trouble);
    for (const TriedPose& other : pose.others) {
        if (other.lead == 0) continue;
        fmt::print("        other {:6.2f} deg lead {:6.1f} odds {:.1f} start {:.1f} {}{}\n",
                   degrees(other.turn), other.lead, other.log_odds, degrees(other.start_angle),
                   other.symmetric ? "symmetric" : "", other.mirrored ? " mirrored" : "");
    }
    std::fflush(stdout);
}

Trial one_trial(const Settings& settings, Fault fault, int seed) {
    PosePhotograph made = pose_photograph(settings.photographs, seed, fault);
    PoseOptions options;
    options.threads = settings.photographs.threads;
    options.both_chiralities = fault == Fault::mirrored;
    if (settings.limit_deg > 0) options.limits.angle = radians(settings.limit_deg);
    if (settings.limit_px > 0) options.limits.shift_px = settings.limit_px;
    if (settings.with_mask) made.photo.mask = made.coverage;
    const double before = clocks().cpu;
    Trial trial;
    trial.pose = find_pose(made.photo, made.model, made.start, options);
    const FoundPose& pose = trial.pose;
    trial.seconds = clocks().cpu - before;
    trial.usable = pose.usable();
    const StoneView found = stone_view(pose.camera, centroid(made.model));
    const Vec3 off = turn_between(made.truth, found, made.symmetry_order);
    trial.angle = degrees(glm::length(off));
    trial.shift = std::hypot(found.at.x - made.truth.at.x, found.at.y - made.truth.at.y);
    trial.scale = found.scale / made.truth.scale - 1;
    const double angle_99 = degrees(pose.sigmas.angle_99), shift_99 = pose.sigmas.shift_99_px;
    trial.held = trial.usable && trial.angle <= angle_99 && trial.shift <= shift_99;
    const bool may_be_right = fault == Fault::none || fault == Fault::turned_start;
    const bool right_hand = fault == Fault::mirrored ? pose.mirrored : !pose.mirrored;
    const bool far = trial.angle > std::min(k_wrong_deg, k_wrong_times * angle_99) ||
                     trial.shift > k_wrong_times * shift_99;
    trial.wrong = trial.usable && (fault == Fault::mirrored ? !right_hand
                                   : may_be_right           ? far || !right_hand
                                                            : true);
    for (int k = 0; k < 3; ++k)
        trial.normalized[static_cast<std::size_t>(k)] =
            off[k] / pose.sigmas.turn[static_cast<std::size_t>(k)];
    if (settings.verbose) print(trial, made.label);
    if (!settings.folder.empty()) {
        std::ofstream file(settings.folder + fmt::format("/seed-{}.png", seed), std::ios::binary);
        const std::string bytes = pose_overlay(made.photo, made.model, pose);
        file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    }
    return trial;
}

void summarize(const std::vector<Trial>& trials) {
    int accepted = 0, held = 0, wrong = 0, mirrored = 0;
    double squares = 0, seconds = 0;
    std::vector<double> angles, shifts, stated;
    for (const Trial& trial : trials) {
        seconds += trial.seconds;
        if (!trial.usable) continue;
        ++accepted;
        held += trial.held ? 1 : 0;
        wrong += trial.wrong ? 1 : 0;
        mirrored += trial.pose.mirrored ? 1 : 0;
        angles.push_back(trial.angle);
        shifts.push_back(trial.shift);
        stated.push_back(degrees(trial.pose.sigmas.angle_99));
        for (double n : trial.normalized) squares += n * n / 3;
    }
    const auto at = [](std::vector<double>& v, double share) {
        std::sort(v.begin(), v.end());
        return v.empty() ? NAN
                         : v[static_cast<std::size_t>(share * static_cast<double>(v.size() - 1))];
    };
    fmt::print(
        "{} photographs: {} accepted, {} of them within what they state at 99 %, {} "
        "wrong, {} mirrored\n",
        trials.size(), accepted, held, wrong, mirrored);
    if (accepted == 0) return;
    fmt::print(
        "of those accepted: view off by {:.2f}, {:.2f}, {:.2f} degrees (median, 90 %, worst), "
        "stated {:.2f}, {:.2f}, {:.2f}; place off by {:.2f}, {:.2f}, {:.2f} pixels\n",
        at(angles, 0.5), at(angles, 0.9), at(angles, 1), at(stated, 0.5), at(stated, 0.9),
        at(stated, 1), at(shifts, 0.5), at(shifts, 0.9), at(shifts, 1));
    fmt::print("errors over their sigmas: {:.2f} (rms); {:.2f} s of processor time each\n",
               std::sqrt(squares / accepted), seconds / static_cast<double>(trials.size()));
}

void add_options(CLI::App& program, Settings& settings) {
    PhotographSettings& photographs = settings.photographs;
    program.add_option("--seeds", settings.seeds);
    program.add_option("--first", settings.first);
    program.add_option("--size", photographs.size);
    program.add_option("--stone-px", settings.stone_px, "the stone's diameter: from, to");
    program.add_option("--facet-deg", photographs.facet_deg);
    program.add_option("--off-standard-deg", photographs.off_standard_deg,
                       "of every other stone, which its model knows");
    program.add_option("--start-deg", photographs.start_deg);
    program.add_option("--tilt-deg", photographs.tilt_deg);
    program.add_option("--jpeg", photographs.jpeg_quality, "quality; 0: not compressed");
    program.add_flag("--crop", photographs.crop);
    program.add_flag("--as-taken", settings.as_taken,
                     "JPEG of quality 85, cropped, blurred by 0.6 to 1.2 pixels, half of the "
                     "stones off-standard by 0.4 degrees");
    program.add_option("--limit-deg", settings.limit_deg);
    program.add_option("--limit-px", settings.limit_px);
    program.add_option("--cut", photographs.cut);
    program.add_option("--light", photographs.light);
    program.add_option("--threads", photographs.threads);
    program.add_option("--overlays", settings.folder);
    program.add_option("--fault", settings.fault,
                       "none, other-cut, other-angles, other-side, mirrored, turned-start, "
                       "no-stone, or all of them (but none)");
    program.add_flag("--mask", settings.with_mask);
    program.add_flag("-v", settings.verbose);
}

}  // namespace

int main(int argc, char** argv) {
    Settings settings;
    CLI::App program("registration on simulated photographs");
    add_options(program, settings);
    CLI11_PARSE(program, argc, argv);
    if (settings.as_taken) {
        settings.photographs.jpeg_quality = 85;
        settings.photographs.crop = true;
        settings.photographs.least_blur = 0.6;
        settings.photographs.most_blur = 1.2;
        settings.photographs.off_standard_deg = 0.4;
    }
    settings.photographs.least_stone_px = settings.stone_px[0];
    settings.photographs.most_stone_px = settings.stone_px[1];
    for (const auto& [name, fault] : faults()) {
        const bool asked = settings.fault == "all" ? fault != Fault::none : settings.fault == name;
        if (!asked) continue;
        std::vector<Trial> trials;
        for (int seed = settings.first; seed < settings.first + settings.seeds; ++seed)
            trials.push_back(one_trial(settings, fault, seed));
        if (settings.fault != "none") fmt::print("{}: ", name);
        summarize(trials);
    }
    return 0;
}
