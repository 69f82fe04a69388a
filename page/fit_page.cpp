#include "page/fit_page.h"

#include <fmt/format.h>

#include <algorithm>

#include "page/drawing.h"
#include "page/fit_fields.h"
#include "page/fit_findings.h"
#include "page/fit_paint.h"
#include "page/fit_tables.h"
#include "page/html.h"
#include "page/parts.h"
#include "page/quantity.h"

namespace culet {

namespace {

using Json = nlohmann::json;

/// All that the fit says in sentences.
std::string fit_words(const Json& fit) {
    std::vector<std::string> sentences;
    for (const Json& sentence : array_at(fit, "summary")) {
        if (sentence.is_string())
            sentences.push_back(escaped(typeset(sentence.get<std::string>())));
    }
    std::string list;
    for (const std::string& sentence : sentences) list += "<li>" + sentence + "</li>\n";
    if (list.empty()) return {};
    return folded(fmt::format("The fit in its own words, {} sentences", sentences.size()),
                  "<ul>" + list + "</ul>\n");
}

std::string fit_figures(const Json& fit, const std::string& unit) {
    std::string rows;
    const auto row = [&](const char* name, const std::string& value) {
        if (value.empty() || value == "–") return;
        rows +=
            fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td></tr>\n", name, escaped(value));
    };
    const auto yes_no = [&](const char* key) {
        return !fit.contains(key) ? "" : true_at(fit, key) ? "yes" : "no";
    };
    std::string status = text_at(fit, "status");
    std::replace(status.begin(), status.end(), '_', ' ');
    row("status", status);
    row("χ² of the readings", significant(number_at(fit, "chi2")));
    row("χ² to be expected (degrees of freedom)", whole(number_at(fit, "dof")));
    row("χ² that is no surprise yet", significant(number_at(fit, "chi2_limit")));
    row("closed", yes_no("closed"));
    row("convex", yes_no("convex"));
    const auto planarity = number_at(fit, "planarity_max");
    row("largest distance of a corner from its plane",
        planarity && *planarity < finest_of(unit) ? "none"
                                                  : significant(planarity, 2) + unit_suffix(unit));
    row("steps of the search", whole(number_at(fit, "iterations")));
    row("seconds", significant(number_at(fit, "seconds"), 2));
    if (rows.empty()) return {};
    return folded("Figures of the search",
                  table("Figures of the search",
                        "<th scope=\"col\">Figure</th><th scope=\"col\">Value</th>", rows));
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
    std::string views;
    for (const ViewSide side : {ViewSide::crown, ViewSide::pavilion, ViewSide::girdle}) {
        const std::string svg = draw_facets_svg(solid, side, paint);
        if (svg.empty()) continue;
        views +=
            fmt::format("<figure{}>{}<figcaption>{}</figcaption></figure>\n",
                        side == ViewSide::girdle ? " class=\"wide\"" : "", svg, caption_of(side));
    }
    if (views.empty()) return {};
    return "<div class=\"drawings\"><div class=\"stones\">\n" + views +
           "</div>\n<p class=\"facet-line\" role=\"status\">Point at a facet, tap it, or step "
           "through with the Tab key.</p></div>\n";
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
