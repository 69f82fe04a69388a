#include "studio/bench_work.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "page/cutting_sheet.h"
#include "stone/gemcad/gemcad_io.h"
#include "stone/text/output_file.h"
#include "stone/text/path_fence.h"
#include "stone/text/text_scan.h"
#include "studio/fit_work.h"
#include "studio/json_text.h"

namespace culet {

namespace fs = std::filesystem;

namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t k_largest_marks = 1u << 20;

// By facet, degrees.
std::map<std::string, double> sigmas_in(const std::string& report) {
    std::map<std::string, double> sigmas;
    if (report.empty()) return sigmas;
    const Json read = Json::parse(report);
    for (const Json& facet : read.at("facets")) {
        const Json& sigma = facet.at("sigma_inclination");
        if (sigma.is_number()) sigmas[facet.at("name").get<std::string>()] = sigma.get<double>();
    }
    return sigmas;
}

std::string mark_line(std::size_t step, const std::string& tier) {
    std::string line = fmt::format("{:02} {}", step, tier);
    for (char& c : line) {
        if (static_cast<unsigned char>(c) < 0x20) c = ' ';
    }
    return std::string(trimmed(line));
}

// A design has no size before a fit.
Json sheet_json(const Stone& stone, bool is_sized, const std::string& report,
                const std::set<std::string>& marks) {
    CuttingSheet sheet;
    sheet.solid = stone.solid;
    sheet.design = cutting_design(stone.solid);
    sheet.steps = cutting_list(stone.solid);
    sheet.teeth = gear_of(stone.solid, {});
    if (is_sized && doubtful_size(stone.solid).empty()) sheet.unit = name_of(stone.unit);
    std::map<std::string, double> sigmas = sigmas_in(report);
    Json json{{"steps", Json::array()}};
    for (const CuttingStep& step : sheet.steps) {
        double most = 0;
        Json facets = Json::array();
        for (const int f : step.facets) {
            const std::string& name = stone.solid.facets[std::size_t(f)].name;
            most = std::max(most, sigmas[name]);
            facets.push_back(name);
        }
        if (!report.empty()) sheet.sigmas_deg.push_back(most);
        json["steps"].push_back({{"facets", std::move(facets)}});
    }
    const std::vector<SheetRow> rows = sheet_rows(sheet);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        json["steps"][i].update({{"tier", rows[i].tier},
                                 {"part", rows[i].part},
                                 {"angle", rows[i].angle},
                                 {"indices", rows[i].indices},
                                 {"depth", rows[i].depth},
                                 {"done", marks.contains(mark_line(i + 1, rows[i].tier))}});
    }
    std::string about = about_sheet(sheet);
    // Advice on an option of the command line.
    constexpr std::string_view k_advice = " (in mm with --width)";
    if (const std::size_t at = about.find(k_advice); at != std::string::npos)
        about.erase(at, k_advice.size());
    json["about"] = about;
    json["note"] = stone.solid.design
                       ? ""
                       : "The mesh holds no design: tiers and their order are as drawn. For the "
                         "author's, begin with a .asc, .gem or .gcs.";
    return json;
}

}  // namespace

std::string bench_json(const LoadedStone& loaded, const FittedStone& fitted, const fs::path& file,
                       int opened) {
    const std::set<std::string> marks = marks_in(file);
    Json json{{"opened", opened},
              {"file", file.string()},
              {"drawn", sheet_json(loaded.file.stone, !is_cut(loaded.file.mesh_file), {}, marks)}};
    if (!fitted.report.empty())
        json["fitted"] = sheet_json(stone_shown(loaded, fitted.solid), true, fitted.report, marks);
    return text_of(json);
}

fs::path marks_file(const fs::path& stone_file) {
    return path_within(stone_file.parent_path(), stone_file.stem().string() + "-bench.txt");
}

std::set<std::string> marks_in(const fs::path& file) {
    std::set<std::string> marks;
    std::error_code ignored;
    if (!fs::exists(file, ignored)) return marks;
    const std::string text = read_text(file, k_largest_marks);
    LineReader lines(text);
    while (const auto line = lines.next()) {
        if (!trimmed(*line).empty()) marks.emplace(trimmed(*line));
    }
    return marks;
}

void mark(const fs::path& file, std::size_t step, const std::string& tier, bool done) {
    std::set<std::string> marks = marks_in(file);
    marks.erase(mark_line(step, tier));
    if (done) marks.insert(mark_line(step, tier));
    std::string text;
    for (const std::string& one : marks) text += one + "\n";
    write_text(file, text);
}

}  // namespace culet
