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

namespace culet {

namespace {

using Json = nlohmann::json;

std::string fit_facts(const Json& fit) {
    const std::string status = text_at(fit, "status");
    std::string words;
    if (status == "converged") words = "The stone below agrees with the readings.";
    if (status == "not_converged")
        words = "The search did not settle: do not rely on the stone below.";
    if (status == "contradictory") words = "The readings contradict one another: see the suspects.";
    if (status == "undetermined") words = "The readings leave some facets free: see below.";
    // The fit's own sentences say more.
    std::string sentences;
    for (const Json& sentence : array_at(fit, "summary")) {
        if (!sentence.is_string()) continue;
        sentences += (sentences.empty() ? "" : " ") + escaped(sentence.get<std::string>());
    }
    if (!sentences.empty()) words = sentences;
    std::string shown_status = status;
    std::replace(shown_status.begin(), shown_status.end(), '_', ' ');
    std::string body = fmt::format(
        "<p><span class=\"badge {}\">{}</span> {}</p>\n", status == "converged" ? "good" : "bad",
        escaped(shown_status.empty() ? "status unknown" : shown_status), words);
    std::string free;
    for (const Json& one : array_at(fit, "undetermined")) {
        free += fmt::format("<li>{}: {}</li>", escaped(text_at(one, "facet")),
                            escaped(text_at(one, "freedom")));
    }
    if (!free.empty()) body += "<p>Left free by the readings:</p><ul>" + free + "</ul>\n";
    const auto yes_no = [&](const char* key) {
        return !fit.contains(key) ? "–" : true_at(fit, key) ? "yes" : "no";
    };
    body += fmt::format(
        "<p class=\"note\">χ² {} with {} degrees of freedom; {} iterations in {} s; closed: {}, "
        "convex: {}, largest distance of a corner from its plane {}.</p>\n",
        significant(number_at(fit, "chi2")), whole(number_at(fit, "dof")),
        whole(number_at(fit, "iterations")), significant(number_at(fit, "seconds")),
        yes_no("closed"), yes_no("convex"), significant(number_at(fit, "planarity_max")));
    return body;
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

std::string fit_section(const FitView& view) {
    const Json fit = parsed_object<Json>(view.fit_json, "the fit report for the page");
    if (fit.empty() && !view.fitted) return {};
    std::string body;
    if (!fit.empty()) body += fit_facts(fit);
    if (view.fitted) {
        body += painted(view, FitColour::residual);
        const std::string sure = painted(view, FitColour::uncertainty);
        if (!sure.empty() && !fit.empty()) {
            body += "<details><summary>How sure: the same views by uncertainty</summary>\n" + sure +
                    "</details>\n";
        }
    }
    body += findings_tables(fit);
    body += readings_table(fit);
    body += facets_table(fit, view.length_unit);
    return section("fit", "The fitted stone", body);
}

}  // namespace culet
