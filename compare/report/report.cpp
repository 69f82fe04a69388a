#include "compare/report/report.h"

#include <nlohmann/json.hpp>

#include "compare/report/report_parts.h"
#include "compare/report/scores_json.h"
#include "page/fit_page.h"
#include "page/json_fields.h"
#include "page/parts.h"
#include "stone/text/output_file.h"

namespace culet {

using Json = nlohmann::json;

std::string photo_word(const Report& report) {
    return report.comparison && report.comparison->simulated ? "simulated photograph"
                                                             : "photograph";
}

std::string report_page(const Report& report) {
    std::string scores_text = report.scores_json;
    if (scores_text.empty() && report.comparison)
        scores_text = scores_json(*report.comparison, {}, report.calibrated);
    const Json scores = parsed_object<Json>(scores_text, "the scores for the report");
    const Json fit = parsed_object<Json>(report.fit_json, "the fit report for the report page");
    const Json stats =
        parsed_object<Json>(report.stats_json, "the render's figures for the report");

    const FitView fitted{report.fit_json, report.fitted, report.length_unit};
    // First the verdict, notable points and the picture; then the explanations.
    std::string page = headline_section(report, fitted) + fit_look_section(fitted);
    const std::string compared = pictures_section(report), rendered = changes_section(report);
    page += compared.empty() ? rendered : compared;
    const bool has_picture = !compared.empty() || report.fitted_render;
    if (!has_picture) page += fit_drawing_section(fitted, false);
    page += fit_proportions_section(fitted);
    page += calibration_section(report);
    page += reflexes_section(report);
    page += maps_section(report);
    if (!compared.empty()) page += rendered;
    page += scores_section(report, scores);
    page += registration_section(report);
    if (has_picture) page += fit_drawing_section(fitted, true);
    page += fit_section(fitted);
    page += plan_section(stats);
    page += provenance_section(report);
    Json data = Json::object();
    if (!scores_text.empty()) data["scores"] = scores;
    if (!report.fit_json.empty()) data["fit"] = fit;
    if (!report.stats_json.empty()) data["stats"] = stats;
    return html_page(report.title, page, data.dump(-1, ' ', false, Json::error_handler_t::replace),
                     report.viewer_html);
}

std::string comparison_part(const Report& report) {
    if (!report.comparison) return {};
    const Json scores = Json::parse(scores_json(*report.comparison, {}, report.calibrated));
    return headline_section(report, {}) + pictures_section(report) + maps_section(report) +
           reflexes_section(report) + scores_section(report, scores) + registration_section(report);
}

void write_report(const Report& report, const std::filesystem::path& file) {
    write_text(file, report_page(report));
}

}  // namespace culet
