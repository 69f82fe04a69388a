// culet photo SHOT... -o PHOTO.exr: combines one or several shots to one picture in linear light.

#include <fmt/format.h>
#include <malloc.h>

#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>

#include "app/program/options.h"
#include "app/program/terminal.h"
#include "compare/photo/bracket.h"
#include "compare/photo/lens.h"
#include "compare/photo/photo_picture.h"
#include "compare/photo/response.h"
#include "compare/photo/white_balance.h"
#include "page/chart.h"
#include "render/colour/colour.h"
#include "render/image/image_io.h"
#include "stone/text/errors.h"
#include "stone/text/output_file.h"

namespace culet {

namespace {

using Json = nlohmann::ordered_json;

struct PhotoArguments {
    CommonOptions common;
    std::vector<std::string> shots, exposures;
    std::string out, grey, white, camera, response, json, plot;
    bool chart = false, as_they_lie = false;
};

PixelRectangle rectangle_in(const std::string& text) {
    PixelRectangle r;
    std::istringstream stream(text);
    char c1 = 0, c2 = 0, c3 = 0, rest = 0;
    if (!(stream >> r.x >> c1 >> r.y >> c2 >> r.width >> c3 >> r.height) || c1 != ',' ||
        c2 != ',' || c3 != ',' || stream >> rest) {
        throw InputError(
            fmt::format("--grey {}: is X,Y,WIDTH,HEIGHT in pixels from the top left", text));
    }
    return r;
}

Bracket read_and_merge(const PhotoArguments& a) {
    if (!a.exposures.empty() && a.exposures.size() != a.shots.size()) {
        throw InputError(fmt::format("--exposure has {} values for {} photographs",
                                     a.exposures.size(), a.shots.size()));
    }
    std::vector<BracketShot> shots;
    for (std::size_t i = 0; i < a.shots.size(); ++i) {
        const std::filesystem::path file = a.shots[i];
        BracketShot shot{a.shots[i], 1, [file] { return read_photo(file); }};
        if (!a.exposures.empty()) {
            shot.exposure = parse_exposure(a.exposures[i]);
        } else if (const auto noted = exposure_of(read_shot_data(file))) {
            shot.exposure = *noted;
        } else if (a.shots.size() > 1) {
            throw InputError(file,
                             "says no exposure time: give one for each photograph with --exposure "
                             "1/10,1/40,...");
        }
        shots.push_back(std::move(shot));
    }
    BracketOptions options;
    options.align = !a.as_they_lie;
    if (a.response == "srgb") options.response = Response::as_read;
    if (a.response == "found") options.response = Response::calibrated;
    return merge_bracket(shots, options, progress_line("merging", a.common.quiet));
}

// Light against the file's value, one line per channel, beside sRGB's.
std::string plot_of(const ResponseCurve& curve) {
    Chart chart;
    chart.title = "Response of the camera";
    chart.about = "linear light for each value of the file, in red, green and blue, beside sRGB's";
    chart.x_label = "value in the file";
    chart.y_label = "linear light, 1: green at 255";
    chart.log_x = false;
    const auto add = [&](const char* name, bool dashed, const auto& light) {
        ChartSeries series;
        series.name = name;
        series.markers = false;
        series.dashed = dashed;
        for (int value = 1; value < 256; ++value)
            series.points.push_back({double(value), light(value), "", ""});
        chart.series.push_back(std::move(series));
    };
    constexpr const char* k_names[]{"red", "green", "blue"};
    for (std::size_t c = 0; c < 3; ++c)
        add(k_names[c], false, [&](int value) { return double(curve[c][std::size_t(value)]); });
    add("sRGB", true, [](int value) { return srgb_decoded(value / 255.0); });
    return draw_chart_svg(chart);
}

// Returns the description for the JSON.
Json balance_white(const PhotoArguments& a, Bracket& merged) {
    Photo& photo = merged.photo;
    Json white;
    Photo other = a.white.empty() ? Photo{} : read_photo(a.white);
    say_notes(a.white, other.notes, a.common.quiet);
    // It is of the same camera, so its values mean the same.
    if (merged.curve && other.encoding.starts_with("8-bit sRGB"))
        apply_response(*merged.curve, other);
    const Photo& with_card = a.white.empty() ? photo : other;
    const std::string where = a.white.empty() ? a.shots[0] : a.white;
    if (a.chart) {
        const auto chart = find_colour_chart(with_card);
        if (!chart) {
            throw InputError(std::filesystem::path(where),
                             "no colour chart of 24 patches found: show it whole, flat and "
                             "evenly lit, or give a grey card with --grey X,Y,WIDTH,HEIGHT");
        }
        balance(photo, chart->gain);
        apply_colour_matrix(photo, chart->matrix);
        white = {{"from", "chart"},
                 {"gain", chart->gain},
                 {"matrix", chart->matrix},
                 {"deltaE00_before", chart->before},
                 {"deltaE00_after", chart->after}};
        say(fmt::format("colour chart: mean CIEDE2000 {:.1f}, now {:.1f}", chart->before,
                        chart->after),
            a.common.quiet);
    } else {
        const GreyCard card = measure_grey(with_card, rectangle_in(a.grey));
        balance(photo, card.gain);
        white = {{"from", "card"},
                 {"gain", card.gain},
                 {"level", card.level},
                 {"unevenness", card.unevenness}};
        say(fmt::format("white balance: red x {:.3f}, blue x {:.3f}", card.gain[0], card.gain[2]),
            a.common.quiet);
        if (card.unevenness > 0.1) {
            merged.notes.push_back(
                fmt::format("the grey card varies by {:.0f} %: avoid shadow or glare on it",
                            100 * card.unevenness));
        }
    }
    return white;
}

void require_consistent(const PhotoArguments& a) {
    for (const std::string& file : {a.out, a.json, a.plot}) require_writable(file);
    if (!a.out.ends_with(".exr"))
        throw InputError(std::filesystem::path(a.out), "linear light is written as .exr");
    if (a.chart && !a.grey.empty()) throw InputError("--chart or --grey, not both");
    if (!a.white.empty() && !a.chart && a.grey.empty())
        throw InputError(
            "--white needs --grey X,Y,WIDTH,HEIGHT or --chart to say what is grey in it");
}

void describe(const PhotoArguments& a, const Bracket& merged, Json& json) {
    const Photo& photo = merged.photo;
    json["response"] = merged.response == Response::calibrated ? "found" : "as read";
    if (merged.curve) {
        json["response_curve"] = {
            {"R", (*merged.curve)[0]}, {"G", (*merged.curve)[1]}, {"B", (*merged.curve)[2]}};
    }
    json["photometric"] = photo.photometric;
    if (!photo.photometric) json["not_photometric"] = photo.not_photometric;
    json["shots"] = Json::array();
    for (std::size_t i = 0; i < a.shots.size(); ++i) {
        json["shots"].push_back(
            {{"file", a.shots[i]}, {"shift_px", {merged.shifts[i].x, merged.shifts[i].y}}});
    }
    json["exposure_ratios"] = merged.exposure_ratios;
    double over = 0;
    for (const float s : photo.saturated) over += s;
    json["over_exposed"] = over / static_cast<double>(photo.rgb.size() / 3);
    json["notes"] = merged.notes;
}

void say_result(const PhotoArguments& a, const Bracket& merged) {
    const Photo& photo = merged.photo;
    const std::string settings = text_of(photo.shot);
    say(fmt::format("{} x {} pixels from {} shot{}{}", photo.width, photo.height, a.shots.size(),
                    a.shots.size() == 1 ? "" : "s", settings.empty() ? "" : ", first " + settings),
        a.common.quiet);
    for (const std::string& note : merged.notes) say("note: " + note, a.common.quiet);
    if (!merged.curve && !a.plot.empty())
        say(fmt::format("note: {} is not written: the response was not found from the shots "
                        "(--response found)",
                        a.plot),
            a.common.quiet);
    if (!photo.photometric) say("note: for shapes only: " + photo.not_photometric, a.common.quiet);
    say(fmt::format("next: culet register {} scene.toml -o posed.toml", a.out), a.common.quiet);
}

int run_photo(const PhotoArguments& a) {
    // Keep freed memory for the next photo: the system clears new memory, which takes a quarter of
    // the time.
    mallopt(M_MMAP_THRESHOLD, 1 << 30);
    mallopt(M_TRIM_THRESHOLD, 1 << 30);
    require_consistent(a);
    Bracket merged = read_and_merge(a);
    Photo& photo = merged.photo;
    Json json{{"schema", 1}, {"size", {photo.width, photo.height}}};

    if (!a.grey.empty() || a.chart) json["white"] = balance_white(a, merged);
    if (!a.camera.empty()) {
        const Lens lens = lens_for(read_lens(a.camera), photo.width, photo.height, a.shots[0]);
        undistort(photo, lens);
        json["lens"] = {{"focal_px", {lens.focal_x, lens.focal_y}},
                        {"principal_px", {lens.principal_x, lens.principal_y}}};
    }
    describe(a, merged, json);

    std::vector<std::pair<std::string, std::string>> text{
        {"culet:photometric", photo.photometric ? "yes" : photo.not_photometric}};
    write_picture(picture_of(photo), a.out, {}, text);
    if (!a.json.empty())
        write_text(a.json, json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
    if (merged.curve && !a.plot.empty()) write_text(a.plot, plot_of(*merged.curve));
    say_result(a, merged);
    return exit_good;
}

}  // namespace

void add_command_photo(CLI::App& program, int& exit_code) {
    auto a = std::make_shared<PhotoArguments>();
    CLI::App* command = program.add_subcommand(
        "photo", "shots of one scene, raw or not, to one picture in linear light");
    command
        ->add_option(
            "SHOT", a->shots,
            "photographs (raw, JPEG, PNG, TIFF, EXR, HDR), several exposures from a tripod")
        ->required();
    command->add_option("-o,--output", a->out, "linear picture with variance and over-exposure")
        ->required()
        ->type_name("PHOTO.exr");
    command
        ->add_option("--exposure", a->exposures,
                     "exposures in the order of the shots: seconds (1/125) or stops (-2EV); "
                     "otherwise from EXIF")
        ->delimiter(',')
        ->type_name("LIST");
    command
        ->add_option("--response", a->response,
                     "of 8-bit files: srgb, or found from the shots (otherwise found from five or "
                     "more JPEGs)")
        ->check(CLI::IsMember({"srgb", "found"}));
    command
        ->add_option("--response-plot", a->plot,
                     "the response that was found, as a chart beside sRGB's")
        ->type_name("FILE.svg");
    command->add_option("--grey", a->grey, "where a grey card is")->type_name("X,Y,WIDTH,HEIGHT");
    command->add_flag("--chart", a->chart, "find a colour chart of 24 patches");
    command
        ->add_option("--white", a->white, "the shot with the card or chart, if it is another one")
        ->type_name("FILE");
    command->add_option("--camera", a->camera, "camera file: take out the lens's distortion")
        ->type_name("CAMERA.toml");
    command->add_flag("--no-align", a->as_they_lie, "the shots are aligned already");
    command->add_option("--json", a->json, "what was found, for programs; - is stdout")
        ->type_name("FILE");
    add_common(*command, a->common);
    command->footer(
        "Examples:\n"
        "  culet photo stone-*.dng -o stone.exr --grey 40,60,200,150 --white card.dng\n"
        "  culet photo a.jpg b.jpg c.jpg -o stone.exr --exposure 1/15,1/60,1/250 --camera "
        "camera.toml");
    command->callback([a, &exit_code] { exit_code = run_photo(*a); });
}

}  // namespace culet
