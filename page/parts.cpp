#include "page/parts.h"

#include <nlohmann/json.hpp>

#include "page/html.h"
#include "page/templates.h"

namespace culet {

namespace embedded {
extern const char* const page_css;
extern const char *const page_js, *const slider_js;
}  // namespace embedded

std::string html_page(const std::string& title, const std::string& body,
                      const std::string& data_json, const std::string& viewer_html) {
    const std::string viewer =
        viewer_html.empty() ? "" : json_for_script(nlohmann::json(viewer_html).dump());
    return filled(templates::page,
                  {{"title", title},
                   {"page_css", embedded::page_css},
                   {"body_html", body},
                   {"data_json", json_for_script(data_json)},
                   {"viewer_json", viewer},
                   {"page_js", std::string(embedded::page_js) + embedded::slider_js}});
}

std::string turn_button() {
    return filled(templates::turn_button, {{"label", "Turn the stone in your hand"}});
}

std::string section(const std::string& id, const std::string& heading, const std::string& body) {
    if (body.empty()) return {};
    return filled(templates::section, {{"id", id}, {"heading", heading}, {"body_html", body}});
}

std::string folded(const std::string& summary, const std::string& body, bool open) {
    if (body.empty()) return {};
    return filled(templates::folded,
                  {{"summary_html", summary}, {"body_html", body}, {"open", open}});
}

std::string folded_section(const std::string& id, const std::string& heading,
                           const std::string& body, bool open) {
    if (body.empty()) return {};
    return filled(templates::folded_section,
                  {{"id", id}, {"heading", heading}, {"body_html", body}, {"open", open}});
}

std::string tile(const std::string& name, const std::string& value, const std::string& about,
                 const char* style) {
    return filled(templates::tile,
                  {{"name", name}, {"value", value}, {"about", about}, {"style", style}});
}

std::string verdict_card(const char* style, const char* symbol, const std::string& word,
                         const std::string& sentences) {
    return filled(templates::verdict_card,
                  {{"style", style}, {"symbol", symbol}, {"word", word}, {"sentences", sentences}});
}

std::string short_list(const std::vector<ListItem>& items) {
    // People read ten lines; collapsing two more would gain nothing.
    constexpr std::size_t k_shown = 8, k_unfolded = 10;
    if (items.empty()) return {};
    const std::size_t shown = items.size() <= k_unfolded ? items.size() : k_shown;
    std::vector<View> first, rest;
    for (std::size_t i = 0; i < items.size(); ++i) {
        (i < shown ? first : rest).push_back({{"lead", items[i].lead}, {"text", items[i].text}});
    }
    const std::string more = rest.empty() ? "" : std::to_string(rest.size());
    return filled(templates::short_list, {{"shown", first}, {"folded", rest}, {"more", more}});
}

bool is_tall(const std::vector<View>& rows) {
    return rows.size() > 24;
}

View table_view(const std::vector<View>& rows) {
    if (rows.empty()) return false;
    return {{"tall", is_tall(rows)}, {"rows", rows}};
}

std::string colour_bar(ColourMap map, const std::string& what, const std::string& from,
                       const std::string& middle, const std::string& to) {
    return filled(templates::colour_bar, {{"colours", css_gradient(map)},
                                          {"what", what},
                                          {"from", from},
                                          {"middle", middle},
                                          {"to", to}});
}

std::string slider(const std::string& id, const SliderSide& left, const SliderSide& right) {
    const auto side = [](const SliderSide& of) {
        return View{{"label", of.label}, {"uri", of.uri}, {"alternative", of.alternative}};
    };
    return filled(templates::slider, {{"id", id}, {"left", side(left)}, {"right", side(right)}});
}

}  // namespace culet
