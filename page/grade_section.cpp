#include "page/grade_section.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <vector>

#include "page/html.h"
#include "page/json_fields.h"
#include "page/templates.h"

namespace culet {

namespace {

using Json = nlohmann::json;

constexpr double k_width = 640, k_air = 4;  // around it, as in the template

struct Box {
    double left = std::numeric_limits<double>::infinity(), right = -left, low = left, high = -left;
    void take(const Json& points) {
        for (const Json& p : points) {
            if (!p.is_array() || p.size() != 2 || !p[0].is_number() || !p[1].is_number()) continue;
            left = std::min(left, p[0].get<double>());
            right = std::max(right, p[0].get<double>());
            low = std::min(low, p[1].get<double>());
            high = std::max(high, p[1].get<double>());
        }
    }
    double scale() const { return k_width / (right - left); }
};

std::string points_in(const Json& points, const Box& box) {
    std::string text;
    for (const Json& p : points) {
        if (!p.is_array() || p.size() != 2 || !p[0].is_number() || !p[1].is_number()) continue;
        text += fmt::format("{}{:.1f},{:.1f}", text.empty() ? "" : " ",
                            (p[0].get<double>() - box.left) * box.scale(),
                            (box.high - p[1].get<double>()) * box.scale());
    }
    return text;
}

}  // namespace

std::string section_drawing(const std::string& section_json) {
    const Json section = parsed_object<Json>(section_json, "the light paths");
    const Json& outline = array_at(section, "outline");
    Box box;
    box.take(outline);
    std::vector<View> paths;
    for (const Json& path : array_at(section, "paths")) box.take(array_at(path, "points"));
    if (outline.empty() || !(box.right > box.left) || !(box.high > box.low)) return {};
    for (const Json& path : array_at(section, "paths")) {
        paths.push_back(
            {{"points", points_in(array_at(path, "points"), box)}, {"end", text_at(path, "end")}});
    }
    return filled(
        templates::grade_section,
        {{"width", fmt::format("{:.0f}", k_width + 2 * k_air)},
         {"height", fmt::format("{:.0f}", (box.high - box.low) * box.scale() + 2 * k_air)},
         {"azimuth", decimals(number_at(section, "azimuth_deg"), 1)},
         {"outline", points_in(outline, box)},
         {"paths", paths}});
}

}  // namespace culet
