#include "page/grade_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>

#include "page/chart.h"
#include "page/grade_section.h"
#include "page/html.h"
#include "page/json_fields.h"
#include "page/parts.h"
#include "page/quantity.h"
#include "page/study_sections.h"
#include "page/templates.h"

namespace culet {

namespace {

using Json = nlohmann::json;

struct Row {
    const char* name;
    const char* about;
    const char* path;   // in the JSON, with dots
    const char* sigma;  // its key there
    double factor;
};

// All in per cent, so that figures can be compared.
constexpr Row k_rows[] = {
    {"Light return, even light", "ISO", "face_up.iso.whole", "iso", 1},
    {"through the table", "ISO", "face_up.iso.table", "iso_table", 1},
    {"Light return, cosine light", "COS", "face_up.cos.whole", "cos", 1},
    {"through the table", "COS", "face_up.cos.table", "cos_table", 1},
    {"Light return, light from the sides", "SC2", "face_up.sc2.whole", "sc2", 1},
    {"through the table", "SC2", "face_up.sc2.table", "sc2_table", 1},
    {"Light return, cos², no head", "WLR of this line of sight", "face_up.wlr.whole", "wlr", 1},
    {"Weighted light return", "GIA's, seen from all around", "weighted_light_return",
     "weighted_light_return", 100},
    {"Useful return", "out of the crown, between head and 64°", "balance.return", "balance.return",
     100},
    {"Into the viewer's head", "", "balance.head", "balance.head", 100},
    {"Out of the crown elsewhere", "", "balance.other", "balance.other", 100},
    {"Leaks", "of the light from above, out of pavilion and girdle", "balance.leak", "balance.leak",
     100},
    {"Reflected on entry", "", "balance.entry_reflection", "balance.entry_reflection", 100},
    {"Not followed to the end", "", "balance.residual", "balance.residual", 100},
    {"Fire", "red and blue at least 0.25° apart", "fire.separated", "fire.separated", 100},
    {"Spectral fire", "cut out of its spectrum by a pupil", "fire.spectral", "fire.spectral", 100},
    {"ASET red", "45° to 75° of elevation", "aset.red", "aset.red", 100},
    {"ASET green", "up to 45°", "aset.green", "aset.green", 100},
    {"ASET blue", "75° to 90°", "aset.blue", "aset.blue", 100},
    {"ASET dark", "of the face, looks out below the girdle", "aset.dark", "aset.dark", 100},
    {"Evenness of hearts", "smallest over largest area", "hearts.evenness", "hearts.evenness", 100},
    {"Evenness of arrows", "smallest over largest area", "arrows.evenness", "arrows.evenness",
     100}};

const Json* found_at(const Json& json, const std::string& path) {
    const Json* at = &json;
    for (std::size_t begin = 0; begin <= path.size();) {
        const std::size_t end = std::min(path.find('.', begin), path.size());
        if (!at->is_object()) return nullptr;
        const auto found = at->find(path.substr(begin, end - begin));
        if (found == at->end()) return nullptr;
        at = &*found;
        begin = end + 1;
    }
    return at;
}

std::optional<double> value_of(const Json& grade, const char* path) {
    const Json* found = found_at(grade, path);
    return found != nullptr && found->is_number() ? std::optional(found->get<double>())
                                                  : std::nullopt;
}

std::string shown(const Json& grade, const Row& row) {
    const std::optional<double> value = value_of(grade, row.path);
    if (!value) return "–";
    // A single pattern is always perfectly even, which says nothing.
    const std::string path = row.path;
    if (path.ends_with(".evenness")) {
        const std::string count = path.substr(0, path.find('.')) + ".count";
        if (value_of(grade, count.c_str()).value_or(2) < 2) return "–";
    }
    const auto sigma = grade.find("sigma");
    if (sigma != grade.end()) {
        if (const auto sure = number_at(*sigma, row.sigma))
            return quantity(row.factor * *value, row.factor * *sure, "%");
    }
    return decimals(row.factor * *value, 2) + unit_suffix("%");
}

std::string name_in(const Json& grade) {
    const std::string name = text_at(grade, "name");
    return name.empty() ? "the stone" : name;
}

// For a chart's key, which has little room.
std::string short_name(const Json& grade, std::size_t number) {
    constexpr std::size_t k_room = 14;
    const std::string name = name_in(grade);
    return name.size() <= k_room ? name : fmt::format("design {}", number);
}

View figures_view(const std::vector<Json>& grades) {
    std::vector<View> columns, rows;
    for (const Json& grade : grades) columns.push_back(name_in(grade));
    for (const Row& row : k_rows) {
        std::vector<View> cells;
        for (const Json& grade : grades) cells.push_back(shown(grade, row));
        rows.push_back({{"name", row.name}, {"about", row.about}, {"cells", cells}});
    }
    return {{"columns", columns}, {"rows", rows}};
}

View pictures_view(const GradeView& view, const std::vector<Json>& grades) {
    std::vector<View> scopes;
    const std::vector<GradePicture>& first = view.designs.front().pictures;
    for (std::size_t scope = 0; scope < first.size(); ++scope) {
        std::vector<View> figures;
        for (std::size_t i = 0; i < view.designs.size(); ++i) {
            if (scope >= view.designs[i].pictures.size()) continue;
            figures.push_back({{"uri", view.designs[i].pictures[scope].uri},
                               {"name", name_in(grades[i])},
                               {"scope", first[scope].scope}});
        }
        scopes.push_back({{"scope", first[scope].scope},
                          {"summary", first[scope].summary},
                          {"figures", figures}});
    }
    return {{"scopes", scopes}};
}

ChartSeries curve_of(const Json& model, const std::string& name, bool dashed) {
    ChartSeries series{name, {}, true, false, dashed};
    const Json &tilts = array_at(model, "tilt_deg"), &whole = array_at(model, "whole"),
               &sigmas = array_at(model, "sigma_whole");
    for (std::size_t i = 0; i < std::min(tilts.size(), whole.size()); ++i) {
        if (!tilts[i].is_number() || !whole[i].is_number()) continue;
        ChartPoint point{tilts[i].get<double>(), whole[i].get<double>(), {}, {}};
        if (i < sigmas.size() && sigmas[i].is_number()) {
            point.y_low = point.y - sigmas[i].get<double>();
            point.y_high = point.y + sigmas[i].get<double>();
        }
        series.points.push_back(point);
    }
    std::sort(series.points.begin(), series.points.end(),
              [](const ChartPoint& a, const ChartPoint& b) { return a.x < b.x; });
    return series;
}

Chart tilt_chart(const std::string& title, const std::string& axis) {
    Chart chart;
    chart.title = title;
    chart.about = title + " against the stone's tilt";
    chart.x_label = "tilt about " + axis + ", degrees";
    chart.y_label = "light return, %";
    chart.log_x = chart.log_y = false;
    return chart;
}

// For one design a chart per axis with all models; for several a chart per model with all designs.
std::vector<View> charts_view(const std::vector<Json>& grades) {
    std::vector<Chart> charts;
    const auto axis_words = [](double degrees) {
        return degrees == 0    ? std::string("x")
               : degrees == 90 ? "y"
                               : fmt::format("azimuth {:g}°", degrees);
    };
    if (grades.size() == 1) {
        for (const Json& model : array_at(grades.front(), "models")) {
            const std::string axis = axis_words(value_at(model, "tilt_azimuth_deg"));
            const std::string title = "Tilted about " + axis;
            auto chart = std::find_if(charts.begin(), charts.end(),
                                      [&](const Chart& c) { return c.title == title; });
            if (chart == charts.end()) chart = charts.insert(charts.end(), tilt_chart(title, axis));
            if (text_at(model, "name") != "random")
                chart->series.push_back(curve_of(model, text_at(model, "name"), false));
        }
    } else {
        for (const char* name : {"iso", "sc2", "wlr"}) {
            Chart chart = tilt_chart(fmt::format("{}, about x and (dashed) y", name), "x or y");
            for (std::size_t i = 0; i < grades.size(); ++i) {
                for (const Json& model : array_at(grades[i], "models")) {
                    if (text_at(model, "name") != name) continue;
                    const bool about_x = value_at(model, "tilt_azimuth_deg") == 0;
                    chart.series.push_back(curve_of(
                        model, short_name(grades[i], i + 1) + (about_x ? "" : ", y"), !about_x));
                }
            }
            charts.push_back(std::move(chart));
        }
    }
    std::vector<View> views;
    for (const Chart& chart : charts)
        views.push_back(
            {{"title", chart.title}, {"chart_html", chart_figure(draw_chart_svg(chart))}});
    return views;
}

std::vector<View> costs_view(const std::vector<Json>& grades) {
    std::vector<View> designs;
    for (const Json& grade : grades) {
        std::vector<View> items;
        for (const Json& cost : array_at(grade, "costs")) {
            items.push_back({{"facet", text_at(cost, "facet")},
                             {"cost", decimals(number_at(cost, "cost"), 2)},
                             {"off", decimals(number_at(cost, "off_deg"), 2)}});
        }
        const bool none = items.empty();
        designs.push_back(
            {{"name", name_in(grade)}, {"tall", is_tall(items)}, {"items", items}, {"none", none}});
    }
    return designs;
}

std::string counted_in(const Json& grade, const char* path, const char* what) {
    return counted_of_eight(
        static_cast<int>(std::clamp(value_of(grade, path).value_or(0), 0.0, 1e6)), what);
}

std::vector<View> headline(const std::vector<Json>& grades) {
    std::vector<View> lines;
    for (const Json& grade : grades)
        lines.push_back(
            {{"name", name_in(grade)},
             {"words",
              fmt::format("{}, {}, light return {} %", counted_in(grade, "hearts.count", "heart"),
                          counted_in(grade, "arrows.count", "arrow"),
                          decimals(value_of(grade, "face_up.iso.whole"), 1))}});
    return lines;
}

// A stone and its drawing count as one; so do a design and what `culet optimize` made of it.
std::string title_of(const std::vector<Json>& grades, bool optimized) {
    const std::string name = name_in(grades.front());
    if (optimized) return name_in(grades.back()) + ": before and after";
    const std::string file = text_at(grades.front(), "file");
    const bool one = std::all_of(grades.begin(), grades.end(), [&](const Json& grade) {
        return !file.empty() && text_at(grade, "file") == file;
    });
    return one || grades.size() == 1 ? name : fmt::format("{} designs", grades.size());
}

std::vector<View> notes_view(const std::vector<Json>& grades) {
    std::vector<View> notes;
    for (const Json& grade : grades) {
        for (const Json& note : array_at(grade, "notes")) {
            if (note.is_string()) notes.push_back(name_in(grade) + ": " + note.get<std::string>());
        }
        if (text_at(grade, "crystal") == "merged") {
            notes.push_back(name_in(grade) +
                            ": a crystal, graded with its mean index; its two waves go one way");
        }
    }
    return notes;
}

}  // namespace

std::string counted_of_eight(int count, const std::string& what) {
    return count <= 8 ? fmt::format("{} of 8 {}s", count, what)
                      : fmt::format("{} {}s", count, what);
}

std::string grade_page(const GradeView& view) {
    std::vector<Json> grades;
    Json data = Json::array();
    for (const GradeDesign& design : view.designs) {
        grades.push_back(parsed_object<Json>(design.json, "the grade"));
        data.push_back(grades.back());
    }
    std::vector<View> sections;
    for (std::size_t i = 0; i < view.designs.size(); ++i) {
        const std::string drawing = section_drawing(view.designs[i].section_json);
        if (!drawing.empty())
            sections.push_back({{"name", name_in(grades[i])}, {"drawing_html", drawing}});
    }
    const std::string title = title_of(grades, !view.optimized_json.empty());
    const std::string body =
        filled(templates::grade, {{"title", title},
                                  {"headline", headline(grades)},
                                  {"index", significant(number_at(grades.front(), "index"), 5)},
                                  {"head", significant(number_at(grades.front(), "head_deg"))},
                                  {"optimized", optimized_view(view.optimized_json)},
                                  {"figures", figures_view(grades)},
                                  {"pictures", pictures_view(view, grades)},
                                  {"charts", charts_view(grades)},
                                  {"sections", sections},
                                  {"costs", costs_view(grades)},
                                  {"notes", notes_view(grades)},
                                  {"version", view.version},
                                  {"command", view.command}});
    return html_page(title + ": what the cut does with light", body, data.dump());
}

}  // namespace culet
