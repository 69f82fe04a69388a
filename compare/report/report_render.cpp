// Sections of the report that come from a render: what changed against the starting mesh, how it
// was rendered, how the page was made.

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "compare/report/report_parts.h"
#include "page/fit_page.h"
#include "page/html.h"
#include "page/json_fields.h"
#include "page/parts.h"
#include "page/quantity.h"

namespace culet {

namespace {

using Json = nlohmann::json;

constexpr float k_covered = 0.5f;  // of a pixel, what the stone must fill to count as its light

double white_of(const Report& report) {
    if (report.renders_white > 0) return report.renders_white;
    // The same for both pictures: brightness is part of what is compared.
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
    std::string body;
    if (report.starting_render && report.fitted_render) {
        const double white = white_of(report);
        body += slider("changes-slider",
                       {"catalogue", picture_uri(*report.starting_render, white),
                        "Render of the stone as it should have been cut"},
                       {"fitted", picture_uri(*report.fitted_render, white),
                        "Render of the stone as it was measured"});
        body +=
            "<p class=\"note\">The same scene with the starting mesh and with the fitted one; "
            "nothing else differs.</p>\n";
    } else if (report.fitted_render && pictures_section(report).empty()) {
        body += fmt::format(
            "<figure class=\"wide\"><img src=\"{}\" alt=\"Render of the stone\"></figure>\n",
            picture_uri(*report.fitted_render, white_of(report)));
        if (!report.starting) return section("changes", "The stone as it would look", body);
    }
    if (report.starting && report.fitted) {
        body += folded("What became steeper and what flatter, drawn",
                       change_drawings(*report.starting, *report.fitted));
        body += folded(fmt::format("{} facets before and after", report.fitted->facets.size()),
                       changes_table(*report.starting, *report.fitted, report.length_unit));
    }
    return section("changes", "Catalogue against fitted", body);
}

std::string plan_section(const Json& stats) {
    if (stats.empty()) return {};
    std::string rows;
    for (const Json& effect : array_at(stats, "effects")) {
        rows += fmt::format(
            "<tr><th scope=\"row\">{}</th><td>{}</td><td>{}</td><td class=\"n\">{}</td></tr>\n",
            escaped(text_at(effect, "name")), true_at(effect, "on") ? "on" : "off",
            escaped(typeset(text_at(effect, "why"))),
            significant(number_at(effect, "error_bound"), 2));
    }
    std::string body;
    if (!rows.empty()) {
        body += table("What was computed, and why",
                      "<th scope=\"col\">Effect</th><th scope=\"col\"></th>"
                      "<th scope=\"col\">Why</th><th scope=\"col\" class=\"n\">Error bound</th>",
                      rows);
    }
    std::string facts;
    const auto fact = [&](const std::string& name, const std::string& value) {
        facts += fmt::format("<tr><th scope=\"row\">{}</th><td class=\"n\">{}</td></tr>\n",
                             escaped(name), value);
    };
    if (!text_at(stats, "engine").empty()) fact("engine", escaped(text_at(stats, "engine")));
    for (const char* key : {"depth", "error_bound", "remainder", "beams", "rays"}) {
        if (number_at(stats, key)) {
            std::string name = key;
            std::replace(name.begin(), name.end(), '_', ' ');
            fact(name, significant(number_at(stats, key)));
        }
    }
    if (stats.contains("seconds") && stats["seconds"].is_object()) {
        for (const auto& [key, value] : stats["seconds"].items()) {
            if (value.is_number()) fact("seconds, " + key, significant(value.get<double>()));
        }
    }
    if (!facts.empty()) {
        body +=
            table("Figures of the render",
                  "<th scope=\"col\">Figure</th><th scope=\"col\" class=\"n\">Value</th>", facts);
    }
    return folded_section("plan", "How it was rendered", body);
}

std::string provenance_section(const Report& report) {
    std::string rows;
    const auto row = [&](const std::string& name, const std::string& value) {
        if (value.empty()) return;
        rows += fmt::format("<tr><th scope=\"row\">{}</th><td class=\"path\">{}</td></tr>\n",
                            escaped(name), escaped(value));
    };
    row("program", report.version.empty() ? "" : "culet " + report.version);
    row("command", report.command);
    for (const ReportFile& file : report.files) row(file.role, file.name);
    if (report.comparison) {
        row("seed", std::to_string(report.comparison->seed));
        row("photograph", report.comparison->simulated ? "simulated" : "as given");
        for (const std::string& note : report.comparison->notes) row("note", note);
    }
    std::string body;
    if (!rows.empty()) {
        body += table("Made from", "<th scope=\"col\">What</th><th scope=\"col\">Which</th>", rows);
    }
    if (!report.settings.empty()) {
        body += fmt::format("<details><summary>Settings</summary><pre>{}</pre></details>\n",
                            escaped(report.settings));
    }
    return folded_section("provenance", "How this page was made", body);
}

}  // namespace culet
