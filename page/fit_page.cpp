#include "page/fit_page.h"

#include <algorithm>

#include "page/drawing.h"
#include "page/fit_fields.h"
#include "page/fit_findings.h"
#include "page/fit_paint.h"
#include "page/fit_tables.h"
#include "page/html.h"
#include "page/parts.h"
#include "page/quantity.h"
#include "page/templates.h"

namespace culet {

namespace {

using Json = nlohmann::json;

std::string fit_words(const Json& fit) {
    std::vector<View> sentences;
    for (const Json& sentence : array_at(fit, "summary")) {
        if (sentence.is_string()) sentences.push_back(typeset(sentence.get<std::string>()));
    }
    if (sentences.empty()) return {};
    return filled(templates::fit_words,
                  {{"count", std::to_string(sentences.size())}, {"sentences", sentences}});
}

std::string fit_figures(const Json& fit, const std::string& unit) {
    std::vector<View> rows;
    const auto row = [&](const char* name, const std::string& value) {
        if (!value.empty() && value != "–") rows.push_back({{"name", name}, {"value", value}});
    };
    const auto yes_no = [&](const char* key) {
        return !fit.contains(key) ? "" : true_at(fit, key) ? "yes" : "no";
    };
    std::string status = text_at(fit, "status");
    std::replace(status.begin(), status.end(), '_', ' ');
    row("status", status);
    row("how far off the readings are, in sigmas, squared and added up (χ²)",
        significant(number_at(fit, "chi2")));
    row("expected (degrees of freedom)", whole(number_at(fit, "dof")));
    row("at most, by chance", significant(number_at(fit, "chi2_limit")));
    row("closed", yes_no("closed"));
    row("convex", yes_no("convex"));
    const auto planarity = number_at(fit, "planarity_max");
    row("largest distance of a corner from its plane",
        planarity && *planarity < finest_of(unit) ? "none"
                                                  : significant(planarity, 2) + unit_suffix(unit));
    row("steps of the search", whole(number_at(fit, "iterations")));
    row("seconds", significant(number_at(fit, "seconds"), 2));
    return rows.empty() ? "" : filled(templates::fit_figures, {{"rows", rows}});
}

std::string painted(const FitView& view, FitColour colour) {
    const FitPaint paint = fit_paint(*view.fitted, view.fit_json, colour);
    const std::string views = stone_views(*view.fitted, paint.facets);
    if (views.empty()) return {};
    const PaintLegend& legend = paint.legend;
    return views + colour_bar(legend.map,
                              legend.what + (legend.mark.empty() ? "" : "; " + legend.mark),
                              legend.from, legend.middle, legend.to);
}

}  // namespace

std::string stone_views(const Solid& solid, const std::vector<FacetPaint>& paint) {
    std::vector<View> views;
    for (const ViewSide side : {ViewSide::crown, ViewSide::pavilion, ViewSide::girdle}) {
        const std::string svg = draw_facets_svg(solid, side, paint);
        if (svg.empty()) continue;
        views.push_back({{"wide", side == ViewSide::girdle},
                         {"drawing_svg", svg},
                         {"caption", caption_of(side)}});
    }
    return views.empty() ? "" : filled(templates::stone_views, {{"views", views}});
}

std::string fit_drawing_section(const FitView& view, bool fold) {
    if (!view.fitted) return {};
    const Json fit = parsed_object<Json>(view.fit_json, "the fit report for the page");
    std::string body = painted(view, FitColour::residual);
    if (!fit.empty()) {
        body += folded("How sure: the same views by uncertainty",
                       painted(view, FitColour::uncertainty));
    }
    const std::string heading = "Drawing of the stone, with its facets' names";
    return fold ? folded_section("drawing", heading, body) : section("drawing", heading, body);
}

std::string fit_section(const FitView& view) {
    const Json fit = parsed_object<Json>(view.fit_json, "the fit report for the page");
    if (fit.empty()) return {};
    return section("fit", "The fit in detail",
                   fit_words(fit) + facets_table(fit, view.length_unit) +
                       readings_table(fit, view.length_unit) +
                       findings_tables(fit, view.length_unit) + fit_figures(fit, view.length_unit));
}

}  // namespace culet
