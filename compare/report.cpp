#include "compare/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "compare/html.h"
#include "compare/report_parts.h"
#include "stone/errors.h"
#include "stone/output_file.h"

namespace culet {

namespace embedded {
extern const char* const report_css;
extern const char* const report_js;
}  // namespace embedded

using Json = nlohmann::json;

Json parsed_object(const std::string& text, const char* what) {
    if (text.empty()) return Json::object();
    try {
        Json json = Json::parse(text);
        if (json.is_object()) return json;
    } catch (const Json::exception&) {
    }
    throw InputError(fmt::format("{}: is no JSON object", what));
}

std::optional<double> number_at(const Json& object, const char* key) {
    if (!object.is_object()) return std::nullopt;
    const auto found = object.find(key);
    if (found == object.end() || !found->is_number()) return std::nullopt;
    return found->get<double>();
}

std::string text_at(const Json& object, const char* key) {
    if (!object.is_object()) return {};
    const auto found = object.find(key);
    if (found == object.end() || !found->is_string()) return {};
    return found->get<std::string>();
}

std::string section(const std::string& id, const std::string& heading, const std::string& body) {
    if (body.empty()) return {};
    return fmt::format(
        "<section id=\"{0}\" aria-labelledby=\"{0}-heading\">\n<h2 id=\"{0}-heading\">{1}</h2>\n"
        "{2}</section>\n",
        id, escaped(heading), body);
}

std::string table(const std::string& caption, const std::string& head, const std::string& body) {
    // More than a screenful scrolls under its heading.
    const bool tall = std::count(body.begin(), body.end(), '\n') > 24;
    return fmt::format(
        "<div class=\"scroll{2}\" tabindex=\"0\" role=\"region\" aria-label=\"{0}\"><table>"
        "<caption>{0}</caption><thead><tr>{1}</tr></thead><tbody>\n{3}</tbody></table></div>\n",
        escaped(caption), head, tall ? " tall" : "", body);
}

std::string colour_bar(ColourMap map, const std::string& what, const std::string& from,
                       const std::string& middle, const std::string& to) {
    return fmt::format(
        "<div class=\"bar\"><div class=\"bar-colours\" style=\"background:{}\"></div>"
        "<div class=\"bar-ticks\"><span>{}</span><span>{}</span><span>{}</span></div>"
        "<div class=\"bar-what\">{}</div></div>\n",
        css_gradient(map), escaped(from), escaped(middle), escaped(to), escaped(what));
}

std::string slider(const std::string& id, const SliderSide& left, const SliderSide& right) {
    return fmt::format(
        "<div class=\"slider\" id=\"{0}\">\n"
        "<div class=\"slider-pictures\">"
        "<figure class=\"under\"><img src=\"{1}\" alt=\"{2}\"><figcaption>{3}</figcaption></figure>"
        "<figure class=\"over\"><img src=\"{4}\" alt=\"{5}\"><figcaption>{6}</figcaption></figure>"
        "<div class=\"slider-line\" aria-hidden=\"true\"></div></div>\n"
        "<input type=\"range\" min=\"0\" max=\"100\" step=\"1\" value=\"50\" "
        "aria-label=\"Divide between {6} on the left and {3} on the right\"></div>\n",
        id, right.uri, escaped(right.alternative), escaped(right.label), left.uri,
        escaped(left.alternative), escaped(left.label));
}

std::string photo_word(const Report& report) {
    return report.comparison && report.comparison->simulated ? "simulated photograph"
                                                             : "photograph";
}

std::string report_page(const Report& report) {
    std::string scores_text = report.scores_json;
    if (scores_text.empty() && report.comparison) scores_text = scores_json(*report.comparison);
    const Json scores = parsed_object(scores_text, "the scores for the report");
    const Json fit = parsed_object(report.fit_json, "the fit report for the report page");
    const Json stats = parsed_object(report.stats_json, "the render's figures for the report");

    std::string page =
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
        "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
        "<meta name=\"color-scheme\" content=\"light dark\">\n"
        // Nothing can be loaded from anywhere, whatever a hostile name might contain.
        "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; "
        "style-src 'unsafe-inline'; script-src 'unsafe-inline'\">\n"
        "<link rel=\"icon\" href=\"data:,\">\n";
    page += fmt::format("<title>{}</title>\n<style>\n{}</style>\n</head>\n<body>\n",
                        escaped(report.title), embedded::report_css);
    page += "<main>\n";
    page += headline_section(report, scores, fit);
    page += pictures_section(report);
    page += maps_section(report);
    page += scores_section(report, scores);
    page += registration_section(report);
    page += changes_section(report);
    page += fit_section(report, fit);
    page += plan_section(stats);
    page += provenance_section(report);
    page += "</main>\n";
    Json data = Json::object();
    if (!scores_text.empty()) data["scores"] = scores;
    if (!report.fit_json.empty()) data["fit"] = fit;
    if (!report.stats_json.empty()) data["stats"] = stats;
    page += fmt::format("<script type=\"application/json\" id=\"culet-data\">{}</script>\n",
                        json_for_script(data.dump(-1, ' ', false, Json::error_handler_t::replace)));
    page += fmt::format("<script>\n{}</script>\n</body>\n</html>\n", embedded::report_js);
    return page;
}

void write_report(const Report& report, const std::filesystem::path& file) {
    write_text(file, report_page(report));
}

}  // namespace culet
