// Report sections from a render: changes against the starting mesh, how it was rendered, how the
// page was made.

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "compare/report/report_parts.h"
#include "compare/templates.h"
#include "page/fit_page.h"
#include "page/html.h"
#include "page/json_fields.h"
#include "page/parts.h"
#include "page/quantity.h"

namespace culet {

namespace {

using Json = nlohmann::json;

constexpr float k_covered = 0.5f;  // least coverage of a pixel that counts as the stone's light

double white_of(const Report& report) {
    if (report.renders_white > 0) return report.renders_white;
    // The same for both pictures, because brightness is part of the comparison.
    std::vector<float> brightest;
    for (const auto* picture : {&report.starting_render, &report.fitted_render}) {
        if (!picture->has_value()) continue;
        const Photo& photo = **picture;
        for (std::size_t p = 0; 3 * p + 2 < photo.rgb.size(); ++p) {
            if (p < photo.coverage.size() && photo.coverage[p] < k_covered) continue;
            const float* rgb = photo.rgb.data() + 3 * p;
            brightest.push_back(std::max({rgb[0], rgb[1], rgb[2]}));
        }
    }
    return white_for_stone(std::move(brightest)).value_or(1);
}

}  // namespace

std::string changes_section(const Report& report) {
    std::string sides, uri, folded_parts;
    if (report.starting_render && report.fitted_render) {
        const double white = white_of(report);
        sides = slider("changes-slider",
                       {"catalogue", picture_uri(*report.starting_render, white),
                        "Render of the stone as it should have been cut"},
                       {"fitted", picture_uri(*report.fitted_render, white),
                        "Render of the stone as it was measured"});
    } else if (report.fitted_render && pictures_section(report).empty()) {
        uri = picture_uri(*report.fitted_render, white_of(report));
    }
    if (report.starting && report.fitted) {
        folded_parts += folded("What became steeper and what flatter, drawn",
                               change_drawings(*report.starting, *report.fitted));
        folded_parts +=
            folded(fmt::format("{} facets before and after", report.fitted->facets.size()),
                   changes_table(*report.starting, *report.fitted, report.length_unit));
    }
    if (sides.empty() && uri.empty() && folded_parts.empty()) return {};
    const bool picture_alone = !uri.empty() && !report.starting;
    return section("changes",
                   picture_alone ? "The stone as it would look" : "Catalogue against fitted",
                   filled(templates::report_changes,
                          {{"slider_html", sides},
                           {"uri", uri},
                           {"turn_html", sides.empty() && uri.empty() ? "" : turn_button()},
                           {"folded_html", folded_parts}}));
}

std::string plan_section(const Json& stats) {
    if (stats.empty()) return {};
    std::vector<View> effects, figures;
    for (const Json& effect : array_at(stats, "effects")) {
        effects.push_back({{"name", text_at(effect, "name")},
                           {"on", true_at(effect, "on")},
                           {"why", typeset(text_at(effect, "why"))},
                           {"bound", significant(number_at(effect, "error_bound"), 2)}});
    }
    const auto figure = [&](const std::string& name, const std::string& value) {
        figures.push_back({{"name", name}, {"value", value}});
    };
    if (!text_at(stats, "engine").empty()) figure("engine", text_at(stats, "engine"));
    for (const char* key : {"depth", "error_bound", "remainder", "beams", "rays"}) {
        if (number_at(stats, key)) {
            std::string name = key;
            std::replace(name.begin(), name.end(), '_', ' ');
            figure(name, significant(number_at(stats, key)));
        }
    }
    if (stats.contains("seconds") && stats["seconds"].is_object()) {
        for (const auto& [key, value] : stats["seconds"].items()) {
            if (value.is_number()) figure("seconds, " + key, significant(value.get<double>()));
        }
    }
    if (effects.empty() && figures.empty()) return {};
    return folded_section("plan", "How it was rendered",
                          filled(templates::report_plan, {{"effects", table_view(effects)},
                                                          {"figures", table_view(figures)}}));
}

std::string provenance_section(const Report& report) {
    std::vector<View> rows;
    const auto row = [&](const std::string& name, const std::string& value) {
        if (!value.empty()) rows.push_back({{"name", name}, {"value", value}});
    };
    row("program", report.version.empty() ? "" : "culet " + report.version);
    row("command", report.command);
    for (const ReportFile& file : report.files) row(file.role, file.name);
    if (report.comparison) {
        row("seed", std::to_string(report.comparison->seed));
        row("photograph", report.comparison->simulated ? "simulated" : "as given");
        for (const std::string& note : report.comparison->notes) row("note", note);
        row("pose", report.comparison->pose_note);
    }
    if (rows.empty() && report.settings.empty()) return {};
    return folded_section("provenance", "How this page was made",
                          filled(templates::report_provenance,
                                 {{"made_from", table_view(rows)}, {"settings", report.settings}}));
}

}  // namespace culet
