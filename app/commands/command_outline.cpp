// culet outline PHOTO... --turntable AXIS --step DEG -o contours.json: outlines of a back-lit stone
// on a turntable, as readings for the fit.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>

#include "app/program/options.h"
#include "app/program/terminal.h"
#include "compare/photo/photo.h"
#include "compare/turntable/turntable.h"
#include "stone/numbers/units.h"
#include "stone/text/errors.h"
#include "stone/text/output_file.h"

namespace culet {

namespace {

using Json = nlohmann::ordered_json;

struct OutlineArguments {
    CommonOptions common;
    std::vector<std::string> photos;
    std::string out, axis = "vertical";
    double step_deg = 0, pixel_mm = 0, width_mm = 0;
};

// Turns the picture by a quarter, left end up, to make the axis upright.
Photo quarter_turned(const Photo& photo) {
    Photo turned = photo;
    turned.coverage.clear();
    turned.variance.clear();
    std::swap(turned.width, turned.height);
    const std::size_t width = std::size_t(photo.width), height = std::size_t(photo.height);
    for (std::size_t y = 0; y < height; ++y) {
        for (std::size_t x = 0; x < width; ++x) {
            for (std::size_t c = 0; c < 3; ++c)
                turned.rgb[3 * (x * height + (height - 1 - y)) + c] =
                    photo.rgb[3 * (y * width + x) + c];
        }
    }
    return turned;
}

std::vector<BackLitOutline> traced(const OutlineArguments& a) {
    std::vector<BackLitOutline> outlines;
    const Progress progress = progress_line("outlines", a.common.quiet);
    int width = 0, height = 0;
    std::set<std::string> told;
    for (std::size_t i = 0; i < a.photos.size(); ++i) {
        if (progress && !progress(double(i) / double(a.photos.size()))) throw Interrupted();
        const std::filesystem::path file = a.photos[i];
        Photo photo = read_photo(file);
        // Notes that hold for all frames of a camera are printed once.
        std::erase_if(photo.notes, [&](const auto& note) { return !told.insert(note).second; });
        say_notes(a.photos[i], photo.notes, a.common.quiet);
        if (i == 0) {
            width = photo.width;
            height = photo.height;
        } else if (photo.width != width || photo.height != height) {
            throw InputError(file, fmt::format("has {} x {} pixels, the first picture {} x {}: the "
                                               "camera must stand still",
                                               photo.width, photo.height, width, height));
        }
        BackLitOutline outline =
            back_lit_outline(a.axis == "horizontal" ? quarter_turned(photo) : photo);
        if (!outline.trouble.empty()) throw InputError(file, outline.trouble);
        outlines.push_back(std::move(outline));
    }
    return outlines;
}

double scale_of(const OutlineArguments& a, const OutlineWidths& widths) {
    return a.pixel_mm > 0 ? a.pixel_mm : a.width_mm / widths.least;
}

// As given, or sorted by the numbers in the files' names if a turntable explains that much better:
// a shell lists turn-10 before turn-2.
Turntable ordered(const OutlineArguments& a, std::vector<BackLitOutline>& outlines) {
    // In reverse order the stone turns the other way and fits as well: require a large improvement.
    constexpr double k_better = 0.5;
    const double step = radians(a.step_deg);
    const Turntable as_given = turntable_of(outlines, step);
    const std::vector<std::size_t> order = order_of_numbers(a.photos);
    if (std::is_sorted(order.begin(), order.end())) return as_given;
    std::vector<BackLitOutline> by_number;
    for (const std::size_t i : order) by_number.push_back(outlines[i]);
    Turntable other = turntable_of(by_number, step);
    if (other.residual_px > k_better * as_given.residual_px) return as_given;
    const auto name = [&](std::size_t i) {
        return std::filesystem::path(a.photos[i]).filename().string();
    };
    say(fmt::format("pictures put in the order of their numbers, {} before {}: outlines then agree "
                    "within {:.2f} px, as given within {:.2f} px",
                    name(order[1]), name(order[2]), other.residual_px, as_given.residual_px),
        a.common.quiet);
    outlines = std::move(by_number);
    return other;
}

Json contours_json(const std::vector<PlacedOutline>& placed, const Turntable& table, double scale) {
    Json json{{"schema", 1},
              {"unit", "mm"},
              {"turntable",
               {{"pixel_mm", scale},
                {"axis_px", table.axis_px},
                {"roll_deg", degrees(table.roll)},
                {"elevation_deg", degrees(table.elevation)},
                {"sigma_axis_px", table.sigma_axis_px},
                {"sigma_roll_deg", degrees(table.sigma_roll)},
                {"sigma_elevation_deg", degrees(table.sigma_elevation)},
                {"residual_px", table.residual_px},
                {"trouble", table.trouble}}},
              {"contours", Json::array()}};
    // Rounds to a hundredth of a micrometre, far below a pixel.
    const auto rounded = [](double mm) { return std::round(mm * 1e5) / 1e5; };
    for (const PlacedOutline& outline : placed) {
        Json points = Json::array();
        for (const Vec3& p : outline.points)
            points.push_back({rounded(p.x), rounded(p.y), rounded(p.z)});
        const Vec3& d = outline.direction;
        json["contours"].push_back({{"direction", {d.x, d.y, d.z}}, {"points", std::move(points)}});
    }
    return json;
}

int run_outline(const OutlineArguments& a) {
    if ((a.pixel_mm > 0) == (a.width_mm > 0))
        throw InputError(
            "say how large a pixel is: --pixel MM, or --width MM, the least width of "
            "the stone that calipers find across the axis");
    require_writable(a.out);
    std::vector<BackLitOutline> outlines = traced(a);
    const Turntable table = ordered(a, outlines);
    const OutlineWidths widths = widths_of(outlines, table);
    const double scale = scale_of(a, widths);
    const Json json =
        contours_json(placed(outlines, radians(a.step_deg), table, scale), table, scale);
    write_text(a.out, json.dump() + "\n");
    std::size_t points = 0;
    for (const BackLitOutline& outline : outlines) points += outline.points.size();
    if (!table.trouble.empty()) {
        say(fmt::format("do not use it: {}. {}.", table.trouble, table.remedy), a.common.quiet);
        return exit_untrusted;
    }
    say(fmt::format("{} outlines, {} points; the stone is {:.3f} to {:.3f} mm wide",
                    outlines.size(), points, scale * widths.least, scale * widths.largest),
        a.common.quiet);
    say(fmt::format("axis {:.2f} ± {:.2f} px from the middle, turned {:.3f} ± {:.3f} degrees in "
                    "the picture, camera {:.3f} ± {:.3f} degrees above the turntable; outlines "
                    "agree to {:.2f} px",
                    table.axis_px, table.sigma_axis_px, degrees(table.roll),
                    degrees(table.sigma_roll), degrees(table.elevation),
                    degrees(table.sigma_elevation), table.residual_px),
        a.common.quiet);
    say(fmt::format("next: [[silhouette]] with file = \"{}\" and frame = \"free\" in a stone file, "
                    "then culet fit",
                    std::filesystem::path(a.out).filename().string()),
        a.common.quiet);
    return exit_good;
}

}  // namespace

void add_command_outline(CLI::App& program, int& exit_code) {
    auto arguments = std::make_shared<OutlineArguments>();
    CLI::App* command = program.add_subcommand(
        "outline",
        "traces the outline of a back-lit stone on a turntable, finds how the turntable stood, and "
        "writes outlines for [[silhouette]] of a stone file");
    command
        ->add_option("PHOTO", arguments->photos, "pictures in the order in which they were taken")
        ->required()
        ->expected(3, 100000)
        ->type_name("PHOTO...");
    command
        ->add_option("--step", arguments->step_deg,
                     "degrees that the stone turned from one picture to the next; positive: "
                     "counter-clockwise as seen from above (from the left, for a horizontal "
                     "axis)")
        ->required()
        ->check(CLI::Range(-180.0, 180.0))
        ->type_name("DEG");
    command->add_option("--turntable", arguments->axis, "how its axis stands in the picture")
        ->check(CLI::IsMember({"vertical", "horizontal"}))
        ->capture_default_str();
    command->add_option("--pixel", arguments->pixel_mm, "side of a pixel at the stone")
        ->check(CLI::PositiveNumber)
        ->type_name("MM");
    command
        ->add_option("--width", arguments->width_mm,
                     "least width of the stone across the axis, as calipers find it, instead")
        ->check(CLI::PositiveNumber)
        ->type_name("MM");
    command->add_option("-o,--output", arguments->out, "contours.json")
        ->required()
        ->type_name("FILE");
    add_common(*command, arguments->common, false);
    command->footer(
        "Example:\n"
        "  culet outline turn-*.png --step 5 --pixel 0.005 -o contours.json\n"
        "Lines of sight are taken as parallel: use a telecentric lens, or a camera whose distance "
        "is a hundred times the stone's width.\n"
        "Exit codes: 0 traced; 1 the outlines contradict each other or do not tell how the camera "
        "stood; 2 could not be done.");
    command->callback([arguments, &exit_code] { exit_code = run_outline(*arguments); });
}

}  // namespace culet
