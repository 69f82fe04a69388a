// culet spin FRAME... -o STONE.obj: a stone from photographs of it on a turntable.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <glm/geometric.hpp>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "app/commands/spin_json.h"
#include "app/commands/spin_report.h"
#include "app/input/cut_symmetry.h"
#include "app/program/options.h"
#include "app/program/terminal.h"
#include "compare/photo/photo.h"
#include "compare/turntable/turntable.h"
#include "refine/spin/series_light.h"
#include "refine/spin/spin.h"
#include "stone/material/material_io.h"
#include "stone/numbers/units.h"
#include "stone/numbers/upper_median.h"
#include "stone/stone.h"
#include "stone/text/errors.h"
#include "stone/text/output_file.h"

namespace culet {

namespace {

namespace fs = std::filesystem;

struct SpinArguments {
    CommonOptions common;
    std::vector<std::string> frames, held_out;
    std::string output, json, report, material, cut;
    double step_deg = 0, width_mm = 0;
};

// All frames as the stone turned. Those that are held out may be among the others; if not, all are
// put in the order of the numbers in their names.
std::vector<std::string> names_of(const SpinArguments& a) {
    std::vector<std::string> names = a.frames;
    std::set<std::string> known;
    for (const std::string& name : names) {
        if (!known.insert(name).second) throw InputError(name, "is given twice");
    }
    bool is_new = false;
    for (const std::string& name : a.held_out) {
        if (!known.insert(name).second) continue;
        names.push_back(name);
        is_new = true;
    }
    if (!is_new) return names;
    std::vector<std::string> bare, sorted;
    for (const std::string& name : names) bare.push_back(fs::path(name).filename().string());
    for (const std::size_t i : order_of_numbers(bare)) sorted.push_back(names[i]);
    return sorted;
}

void require_one_size(const std::vector<SpinFrame>& frames) {
    const auto size_of = [](const SpinFrame& frame) {
        return fmt::format("{} x {}", frame.picture.width, frame.picture.height);
    };
    std::map<std::string, std::size_t> counts;
    for (const SpinFrame& frame : frames) ++counts[size_of(frame)];
    const auto usual =
        std::max_element(counts.begin(), counts.end(),
                         [](const auto& a, const auto& b) { return a.second < b.second; });
    for (const SpinFrame& frame : frames) {
        if (size_of(frame) != usual->first)
            throw InputError(
                fs::path(frame.name),
                fmt::format("has {} pixels, {} of {} frames have {}: leave it out or "
                            "give it as large as the others, from the same place",
                            size_of(frame), usual->second, frames.size(), usual->first));
    }
}

std::vector<SpinFrame> frames_of(const SpinArguments& a) {
    const std::set<std::string> held_out(a.held_out.begin(), a.held_out.end());
    const Progress progress = progress_line("reading frames", a.common.quiet);
    std::vector<SpinFrame> frames;
    const std::vector<std::string> names = names_of(a);
    for (const std::string& name : names) {
        if (progress && !progress(double(frames.size()) / double(names.size())))
            throw Interrupted();
        frames.push_back({name, levels_of(read_photo(name)), held_out.count(name) > 0});
    }
    require_one_size(frames);
    return frames;
}

Solid scaled(Solid solid, double scale) {
    for (Vec3& v : solid.vertices) v *= scale;
    for (Facet& f : solid.facets) f.plane.offset *= scale;
    return solid;
}

void say_result(const SpinArguments& a, const std::vector<SpinFrame>& frames,
                const SpinResult& found) {
    if (found.trouble.empty()) {
        for (const std::string& note : found.notes) say(note, a.common.quiet);
    }
    std::vector<double> own, left_out;
    for (std::size_t f = 0; f < frames.size(); ++f) {
        const SpinFrameResult& frame = found.frames[f];
        if (!frame.trouble.empty())
            say(fmt::format("{}: not used: {}", frames[f].name, frame.trouble), a.common.quiet);
        else
            (frame.used ? own : left_out).push_back(frame.median_px);
    }
    say(fmt::format("{} facets from {} frames; camera {:.2f} degrees above the turntable; half "
                    "of the edges lie within {:.2f} px of the stone's outlines{}",
                    found.solid.facets.size(), own.size(), degrees(found.camera.elevation),
                    upper_median(own),
                    left_out.empty() ? ""
                                     : fmt::format(", in the {} frames left out within {:.2f} px",
                                                   left_out.size(), upper_median(left_out))),
        a.common.quiet);
    say(fmt::format("the stone is {:.1f} px wide{}", found.width().value,
                    a.width_mm > 0 ? "" : "; --width MM gives its lengths in mm"),
        a.common.quiet);
    if (const SpinProportion* table = proportion(found.proportions, "table_pct"))
        say(fmt::format("table and crown by {} edges of the surface: the table is {:.1f} \u00b1 "
                        "{:.1f} % of the width",
                        found.edges, table->value, table->sigma),
            a.common.quiet);
    else
        say("no edges of a table were found: the stone is closed by planes that nothing shows",
            a.common.quiet);
    if (found.symmetry)
        say(fmt::format("facets repeat {}: {} are alike within {:.2f} degrees; {} that no frame "
                        "shows are copies",
                        words_of(found.tried), found.symmetry->pairs,
                        degrees(found.symmetry->tilt_sigma), found.copies.size()),
            a.common.quiet);
    if (found.unseen.size() > found.copies.size())
        say(fmt::format("no frame shows {} of the facets edge-on: they close the stone, and their "
                        "tilt is a guess (\"unseen\" in --json)",
                        found.unseen.size() - found.copies.size()),
            a.common.quiet);
    if (!found.width().read)
        say("such facets bound the width: the scale is not to be trusted", a.common.quiet);
    if (!found.trouble.empty())
        say(fmt::format("do not use it: {}. {}.", found.trouble, found.remedy), a.common.quiet);
}

int run_spin(const SpinArguments& a) {
    require_solid_name(a.output);
    require_writable(a.output);
    require_writable(a.json);
    const std::optional<Material> material =
        a.material.empty() ? std::nullopt : std::optional(material_called(a.material));
    const std::vector<SpinFrame> frames = frames_of(a);
    SpinOptions options;
    options.step = radians(a.step_deg);
    options.threads = a.common.threads;
    if (!a.cut.empty()) {
        const GivenCut cut = given_cut(a.cut);
        options.symmetry = cut.symmetry;
        if (!cut.convex)
            say("this cut is hollow in places: culet spin finds its convex hull", a.common.quiet);
    }
    const SpinResult found =
        spin(frames, options, progress_line("finding the stone", a.common.quiet));
    const double px_mm = a.width_mm > 0 ? a.width_mm / found.width().value : 1;
    auto json = spin_json(frames, found, a.width_mm);
    SeriesLight light;
    if (material) {
        light = series_light(frames, found, *material, a.common.threads);
        add_light(frames, a.material, light, json);
    }
    say_notes(a.output, write_solid(scaled(found.solid, px_mm), a.output), a.common.quiet);
    if (!a.json.empty()) write_text(a.json, json.dump(2) + "\n");
    if (!a.report.empty()) {
        write_spin_report(a.report, frames, found, light, a.width_mm);
        say(fmt::format("report: {}; next: open it in a browser",
                        (fs::path(a.report) / "report.html").string()),
            a.common.quiet);
    }
    say_result(a, frames, found);
    if (!light.verdict.empty()) say(light.verdict, a.common.quiet);
    return found.trouble.empty() ? exit_good : exit_untrusted;
}

}  // namespace

void add_command_spin(CLI::App& program, int& exit_code) {
    auto arguments = std::make_shared<SpinArguments>();
    SpinArguments& a = *arguments;
    CLI::App* command = program.add_subcommand(
        "spin", "a stone from photographs of it on a turntable, in any light");
    command->add_option("FRAME", a.frames, "photographs of one turn, in the order of turning")
        ->required()
        ->expected(1, 100000)
        ->type_name("FRAME...");
    command->add_option("-o,--output", a.output, "the stone (.obj .off .ply .stl)")
        ->required()
        ->type_name("STONE");
    command
        ->add_option("--cut", a.cut,
                     "that the stone has: a standard cut, a mesh or a design; facets that it "
                     "repeats about its axis are taken as nearly alike")
        ->type_name("NAME|MESH|DESIGN");
    command
        ->add_option("--step", a.step_deg,
                     "degrees from one frame to the next, either way (default: one turn in all)")
        ->check(CLI::Range(0.01, 120.0))
        ->type_name("DEG");
    command
        ->add_option("--width", a.width_mm,
                     "the stone's least width across its table, as calipers find it (default: "
                     "lengths in pixels)")
        ->check(CLI::PositiveNumber)
        ->type_name("MM");
    command
        ->add_option("--hold-out", a.held_out,
                     "frames of which only the turn is found, to check the stone by")
        ->type_name("FRAME...");
    command
        ->add_option("--material", a.material,
                     "of the stone: estimates the light, and compares renders in it with the "
                     "frames left out")
        ->type_name("NAME");
    command
        ->add_option("--json", a.json,
                     "turn and projection of each frame, the camera, the facets; - is stdout")
        ->type_name("FILE");
    command
        ->add_option("--report", a.report,
                     "folder for report.html: the stone turning beside its photographs, and its "
                     "proportions")
        ->type_name("DIR");
    add_common(*command, a.common, false);
    command->footer(
        "Examples:\n"
        "  culet spin turn-*.jpg -o stone.obj --json spin.json\n"
        "  culet spin turn-*.jpg --cut asscher -o stone.obj --report report\n"
        "  culet spin f0*.jpg --hold-out f010.jpg f020.jpg --width 6.98 -o stone.obj\n"
        "Exit codes: 0 found; 1 found, not to be trusted; 2 could not be done.");
    command->callback([arguments, &exit_code] { exit_code = run_spin(*arguments); });
}

}  // namespace culet
