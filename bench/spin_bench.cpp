// Makes spin series of off-standard stones with known facets, and measures what `spin` finds.
//     bench_spin [--stones 10] [--first 0] [--frames 64] [--size 600] [--cut] [--write FOLDER]

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>

#include "bench/spin_error.h"
#include "stone/cuts/cuts.h"
#include "stone/numbers/units.h"
#include "stone/text/errors.h"
#include "tests/cpu_time.h"
#include "tests/fit/test_stones.h"

namespace culet::bench {

namespace {

struct Options {
    int stones = 10, first = 0, frames = 64, size = 600;
    bool cut = false;
    std::string folder;
};

struct Kind {
    const char* name;
    const char* cut;
    std::map<std::string, double> values;
    double tilt_deg, elevation_deg;  ///< facets off the design; the camera
};

// Facets are off by 0.3 to 1 degrees, cameras stand 20 to 50 degrees above the turntable.
const std::array<Kind, 10> k_kinds{{
    {"asscher", "step", {{"ratio", 1}, {"corner", 29}, {"pavilion-angle", 50}}, 0.5, 50},
    {"square step", "step", {{"ratio", 1.02}, {"corner", 20}, {"table", 66}}, 1.0, 40},
    {"emerald", "step", {{"ratio", 1.4}}, 0.3, 45},
    {"princess", "princess", {}, 0.4, 40},
    {"round", "round-brilliant", {}, 0.3, 35},
    {"oval", "oval", {}, 0.5, 30},
    {"cushion", "cushion", {}, 0.8, 45},
    {"pear", "pear", {}, 0.6, 25},
    {"marquise", "marquise", {}, 0.4, 50},
    {"trillion", "trillion", {}, 0.7, 20},
}};

// The most memory since the last call, MB: Linux can set its record back.
double peak_memory() {
    std::ifstream status("/proc/self/status");
    double kb = 0;
    for (std::string line; std::getline(status, line);) {
        if (line.rfind("VmHWM:", 0) == 0) kb = std::stod(line.substr(6));
    }
    std::ofstream("/proc/self/clear_refs") << "5";
    return kb / 1024;
}

void write_frames(const std::vector<SpinFrame>& frames, const std::filesystem::path& folder) {
    std::filesystem::create_directories(folder);
    for (const SpinFrame& f : frames) {
        const cv::Mat rgb(f.picture.height, f.picture.width, CV_8UC3,
                          const_cast<std::uint8_t*>(f.picture.rgb.data()));
        cv::Mat bgr;
        cv::cvtColor(rgb, bgr, cv::COLOR_RGB2BGR);
        cv::imwrite((folder / f.name).string(), bgr);
    }
}

std::string table_text(const SpinError& e) {
    if (e.table < 0) return "-, -, -";
    return fmt::format("{:.2f}, {:.1f}, {:.1f}", degrees(e.table), 100 * e.table_part,
                       100 * e.true_table_part);
}

struct Sums {
    double squares = 0;
    int facets = 0, found = 0, within = 0;
};

void measure(const Options& o, int k, Sums& sums) {
    const Kind& kind = k_kinds[std::size_t(k)];
    const Solid stone =
        test::off_standard(make_cut(kind.cut, kind.values), kind.tilt_deg, 0.005, unsigned(k + 1));
    synthetic::SpinTruth truth = synthetic::lying(stone, 0.62 * o.size, radians(kind.elevation_deg),
                                                  o.frames, unsigned(k + 1));
    truth.size = o.size;
    truth.specks = 1500;
    truth.lit = true;
    const std::vector<SpinFrame> frames = synthetic::frames_of(truth);
    if (!o.folder.empty()) write_frames(frames, std::filesystem::path(o.folder) / kind.name);
    peak_memory();
    const Clocks begin = clocks();
    SpinResult found;
    try {
        SpinOptions options;
        if (o.cut) options.symmetry = symmetry_of(make_cut(kind.cut, kind.values));
        found = spin(frames, options);
    } catch (const InputError& error) {
        fmt::print("| {} | {} |\n", kind.name, error.what());
        return;
    }
    const Clocks end = clocks();
    const double memory = peak_memory();
    const SpinError e = error_of(found, truth);
    sums.squares += e.found * e.tilt_rms * e.tilt_rms;
    sums.facets += e.facets;
    sums.found += e.found;
    sums.within += e.within;
    fmt::print(
        "| {} | {:g} | {} of {} | {:.2f}, {:.2f} | {:.0f} % | {} | {:.3f} | {:.0f} | {:.2f} | "
        "{} |\n",
        kind.name, kind.elevation_deg, e.found, e.facets, degrees(e.tilt_rms),
        degrees(e.tilt_median), 100.0 * e.within / std::max(1, e.found), table_text(e),
        degrees(e.turn_rms), end.wall - begin.wall, memory / 1000,
        found.trouble.empty() ? "" : found.trouble);
    std::fflush(stdout);
}

int run(const Options& o) {
    fmt::print("{} frames of {} x {} pixels\n\n", o.frames, o.size, o.size);
    fmt::print(
        "| stone | camera, deg | facets of 1 mm2 found | error, rms and median, deg | within "
        "sigma | table: error, deg; part found and true, % | turns, rms, deg | s | GB | "
        "doubt |\n|---|---|---|---|---|---|---|---|---|---|\n");
    Sums sums;
    for (int k = o.first; k < std::min(o.first + o.stones, int(k_kinds.size())); ++k)
        measure(o, k, sums);
    fmt::print("\n{} of {} facets found, {:.3f} degrees rms, {:.0f} % within their sigma\n",
               sums.found, sums.facets, degrees(std::sqrt(sums.squares / std::max(1, sums.found))),
               100.0 * sums.within / std::max(1, sums.found));
    return 0;
}

}  // namespace

}  // namespace culet::bench

int main(int argc, char** argv) {
    CLI::App program("stones from simulated spin series");
    culet::bench::Options o;
    program.add_option("--stones", o.stones)->capture_default_str();
    program.add_option("--first", o.first)->capture_default_str();
    program.add_option("--frames", o.frames)->capture_default_str();
    program.add_option("--size", o.size)->capture_default_str();
    program.add_flag("--cut", o.cut, "the symmetry of the cut is given");
    program.add_option("--write", o.folder, "where to leave the frames");
    CLI11_PARSE(program, argc, argv);
    return culet::bench::run(o);
}
