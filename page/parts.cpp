#include "page/parts.h"

#include <fmt/format.h>

#include <algorithm>

#include "page/html.h"

namespace culet {

namespace embedded {
extern const char* const page_css;
extern const char* const page_js;
}  // namespace embedded

std::string html_page(const std::string& title, const std::string& body,
                      const std::string& data_json) {
    std::string page =
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
        "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
        "<meta name=\"color-scheme\" content=\"light dark\">\n"
        "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; "
        "style-src 'unsafe-inline'; script-src 'unsafe-inline'\">\n"
        "<link rel=\"icon\" href=\"data:,\">\n";
    page += fmt::format("<title>{}</title>\n<style>\n{}</style>\n</head>\n<body>\n<main>\n",
                        escaped(title), embedded::page_css);
    page += body;
    page += "</main>\n";
    if (!data_json.empty()) {
        page += fmt::format("<script type=\"application/json\" id=\"culet-data\">{}</script>\n",
                            json_for_script(data_json));
    }
    page += fmt::format("<script>\n{}</script>\n</body>\n</html>\n", embedded::page_js);
    return page;
}

std::string section(const std::string& id, const std::string& heading, const std::string& body) {
    if (body.empty()) return {};
    return fmt::format(
        "<section id=\"{0}\" aria-labelledby=\"{0}-heading\">\n<h2 id=\"{0}-heading\">{1}</h2>\n"
        "{2}</section>\n",
        id, escaped(heading), body);
}

std::string folded(const std::string& summary, const std::string& body, bool open) {
    if (body.empty()) return {};
    return fmt::format("<details{}><summary>{}</summary>\n{}</details>\n", open ? " open" : "",
                       summary, body);
}

std::string folded_section(const std::string& id, const std::string& heading,
                           const std::string& body, bool open) {
    if (body.empty()) return {};
    return fmt::format(
        "<section id=\"{0}\" class=\"folded\" aria-labelledby=\"{0}-heading\">\n{1}"
        "</section>\n",
        id, folded(fmt::format("<h2 id=\"{}-heading\">{}</h2>", id, escaped(heading)), body, open));
}

std::string tile(const std::string& name, const std::string& value, const std::string& about,
                 const char* style) {
    return fmt::format("<div class=\"tile {}\"><dt>{}</dt><dd><b>{}</b><span>{}</span></dd></div>",
                       style, escaped(name), value, escaped(about));
}

std::string verdict_card(const char* style, const char* symbol, const std::string& word,
                         const std::string& body) {
    return fmt::format(
        "<div class=\"verdict {}\"><span class=\"symbol\" aria-hidden=\"true\">{}</span>"
        "<div><p class=\"word\">{}</p>{}</div></div>\n",
        style, symbol, escaped(word), body);
}

std::string short_list(const std::vector<std::string>& items) {
    // Ten lines are read; with two more nothing would be won by folding them.
    constexpr std::size_t k_shown = 8, k_unfolded = 10;
    if (items.empty()) return {};
    const std::size_t shown = items.size() <= k_unfolded ? items.size() : k_shown;
    std::string first, rest;
    for (std::size_t i = 0; i < items.size(); ++i) {
        (i < shown ? first : rest) += "<li>" + items[i] + "</li>\n";
    }
    first = "<ul>" + first + "</ul>\n";
    if (rest.empty()) return first;
    return first + folded(fmt::format("{} more", items.size() - shown), "<ul>" + rest + "</ul>\n");
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
        "aria-label=\"Divide between {6} on the left and {3} on the right\">"
        "<button type=\"button\" class=\"blink\" aria-pressed=\"false\" hidden>Blink</button>"
        "</div>\n",
        id, right.uri, escaped(right.alternative), escaped(right.label), left.uri,
        escaped(left.alternative), escaped(left.label));
}

}  // namespace culet
