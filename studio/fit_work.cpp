#include "studio/fit_work.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "fit/findings/summary.h"
#include "fit/findings/words.h"
#include "fit/fit.h"
#include "page/drawing.h"
#include "page/fit_page.h"
#include "page/fit_paint.h"
#include "stone/mesh/mesh_io.h"
#include "stone/solid_input.h"
#include "stone/text/path_fence.h"
#include "studio/json_text.h"
#include "viewer/view_item.h"
#include "viewer/viewer_page.h"

namespace culet {

namespace {

using Json = nlohmann::ordered_json;

// Of a reading's redundancy. Below it the fit follows whatever was read, and does not contradict
// the first check.
constexpr double k_checked = 0.1;

// Views of a stone in one manner of colouring.
Json drawing_json(const Solid& solid, const std::vector<FacetPaint>& paint,
                  const PaintLegend& legend) {
    Json json{{"views", Json::array()}, {"legend", legend.what}, {"mark", legend.mark}};
    for (const ViewSide side : {ViewSide::crown, ViewSide::pavilion}) {
        Json facets = Json::array();
        for (const SeenFacet& seen : view_of(solid, side, 1).facets)
            facets.push_back(solid.facets[std::size_t(seen.facet)].name);
        json["views"].push_back({{"svg", draw_facets_svg(solid, side, paint)},
                                 {"caption", caption_of(side)},
                                 {"facets", std::move(facets)}});
    }
    if (!legend.what.empty()) {
        json["gradient"] = css_gradient(legend.map);
        json["ticks"] = {legend.from, legend.middle, legend.to};
    }
    return json;
}

Json drawings_json(const Solid& solid, const std::string& report) {
    Json json;
    for (const auto& [name, colour] :
         {std::pair{"residual", FitColour::residual}, std::pair{"sigma", FitColour::uncertainty}}) {
        const FitPaint paint = fit_paint(solid, report, colour);
        json[name] = drawing_json(solid, paint.facets, paint.legend);
    }
    return json;
}

// `readings.csv line 12` is the fourth row of the table, say, which shows no lines.
std::string with_rows(const std::string& text, const LoadedStone& loaded) {
    std::map<std::string, int> row_of;
    for (const WrittenReading& written : loaded.written) {
        if (written.file == loaded.readings)
            row_of.emplace(std::to_string(written.line), int(row_of.size()) + 1);
    }
    const std::string place = loaded.readings.filename().string() + " line ";
    std::string told;
    for (std::size_t at = 0;;) {
        const std::size_t next = text.find(place, at);
        told += text.substr(at, next - at);
        if (next == std::string::npos) return told;
        at = std::min(text.find_first_not_of("0123456789", next + place.size()), text.size());
        const auto row = row_of.find(text.substr(next + place.size(), at - next - place.size()));
        told +=
            row == row_of.end() ? text.substr(next, at - next) : fmt::format("row {}", row->second);
    }
}

// Without the name of the file, which the table stands for.
std::string in_the_table(const std::string& words, const Reading& reading) {
    const std::string place = place_words(reading) + ": ";
    return words.starts_with(place) ? words.substr(place.size()) : words;
}

Json flag_json(const FitResult& result, const Reading& reading) {
    Json flag;
    const auto& doubts = result.findings.doubts;
    const auto told = std::find_if(doubts.begin(), doubts.end(), [&](const std::string& words) {
        return words.starts_with(place_words(reading) + ":");
    });
    flag["what"] = sentence_of(told != doubts.end() ? in_the_table(*told, reading)
                                                    : suspect_words(result, reading.id));
    for (const Proposal& proposal : result.findings.proposals) {
        if (proposal.id != reading.id || proposal.slip.empty()) continue;
        flag["suggested"] = fmt::format("{:.6g}", file_unit(reading.kind) * proposal.corrected);
        flag["slip"] = proposal.slip;
    }
    return flag;
}

// By line of the readings file; a row may hold several readings, of which the worst counts.
Json rows_json(const LoadedStone& loaded, const std::vector<Reading>& bound,
               const FitResult& result) {
    std::map<std::string, const Reading*> by_id;
    for (const Reading& reading : bound) {
        if (reading.file == loaded.readings) by_id[reading.id] = &reading;
    }
    std::map<long, Json> rows;
    for (const FittedReading& fitted : result.readings) {
        const auto found = by_id.find(fitted.id);
        if (found == by_id.end()) continue;
        Json& row = rows[found->second->line];
        row["line"] = found->second->line;
        row["checked"] = row.value("checked", true) && fitted.redundancy >= k_checked;
        const double off = std::abs(fitted.normalized);
        if (std::isfinite(off) && fitted.left_out.empty())
            row["off"] = std::max(row.value("off", 0.0), off);
        if (fitted.suspect && !row.contains("flag"))
            row["flag"] = flag_json(result, *found->second);
    }
    Json json = Json::array();
    for (auto& [line, row] : rows) json.push_back(std::move(row));
    return json;
}

}  // namespace

std::string fit_for_screen(const LoadedStone& loaded, const std::string& start,
                           const Progress& progress) {
    const FitInput input = fit_input(loaded.file.stone, loaded.written);
    FitOptions options = loaded.options;
    if (!start.empty()) {
        Solid earlier = solid_of_bytes(start, "earlier.obj").solid;
        const auto& facets = input.stone.solid.facets;
        const bool fits = std::all_of(facets.begin(), facets.end(), [&](const Facet& facet) {
            return find_facet(earlier, facet.name) >= 0;
        });
        if (fits) options.start = std::move(earlier);
    }
    const FitResult result = fit_stone(input, options, progress);
    const std::string report = fit_report(result);
    const FitView view{report, result.solid, std::string(name_of(result.unit))};
    Json json{
        {"status", name_of(result.status)},
        {"card_html", with_rows(fit_card(view), loaded)},
        {"look_html", with_rows(fit_look_section(view), loaded)},
        {"stone_html", with_rows(fit_look_section(view) + fit_proportions_section(view), loaded)},
        {"next", next_step(result)},
        {"rows", rows_json(loaded, input.readings, result)},
        {"seconds", result.log.seconds},
        {"drawings", drawings_json(result.solid, report)}};
    if (!result.findings.help.empty()) {
        const NextReading& help = result.findings.help.front();
        json["next_reading"] = {{"kind", name_of(help.kind)}, {"of", help.of}};
    }
    if (result.status != FitStatus::not_converged) {
        json["solid"] = mesh_text(result.solid, MeshFormat::obj);
        // Nothing here needs its largest part.
        Json kept = Json::parse(report);
        kept.erase("facet_covariance");
        json["report"] = text_of(kept);
    }
    return text_of(json);
}

std::string plain_drawings(const Solid& solid) {
    return text_of(Json{{"mesh", drawing_json(solid, {}, {})}});
}

Stone stone_shown(const LoadedStone& loaded, const std::string& solid) {
    Stone stone = loaded.file.stone;
    if (!loaded.file.has_material) stone.material = catalogue_material("diamond");
    if (solid.empty()) return stone;
    stone.solid = solid_of_bytes(solid, "fitted.obj").solid;
    stone.up_facet.clear();
    stone.up = {0, 0, 1};
    return stone;
}

std::string page_of_stone(const LoadedStone& loaded, const std::string& solid,
                          const std::string& report, const std::string& version) {
    const PathFence fence(loaded.file.mesh_file.parent_path());
    const Stone stone = stone_shown(loaded, solid);
    ViewSource source;
    source.file = loaded.file.mesh_file;
    source.choices.material = "diamond";  // replaced with the stone
    source.stone = &stone;
    if (!solid.empty()) {
        source.fit_json = report;
        source.catalogue = &loaded.file.stone.solid;
    }
    std::vector<std::string> notes;
    ViewDocument document;
    document.items.push_back(view_item(source, notes));
    document.title = stone.name;
    document.version = version;
    return viewer_page(std::move(document));
}

}  // namespace culet
