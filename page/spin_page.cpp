#include "page/spin_page.h"

#include <fmt/format.h>

#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "page/html.h"
#include "page/parts.h"
#include "page/template.h"
#include "page/templates.h"

namespace culet {

namespace {

// What page.js draws: corners, facets with planes, and a photograph and a projection for each turn.
std::string player_json(const SpinPage& page) {
    nlohmann::json json{{"width", page.width}, {"height", page.height}};
    json["corners"] = nlohmann::json::array();
    for (const Vec3& v : page.solid.vertices) json["corners"].push_back({v.x, v.y, v.z});
    json["facets"] = nlohmann::json::array();
    for (std::size_t f = 0; f < page.solid.facets.size(); ++f) {
        const Facet& facet = page.solid.facets[f];
        const Plane& plane = facet.plane;
        json["facets"].push_back(
            {{"corners", facet.corners},
             {"plane", {plane.normal.x, plane.normal.y, plane.normal.z, plane.offset}},
             {"seen", bool(page.seen[f])}});
    }
    json["frames"] = nlohmann::json::array();
    for (const SpinPage::Frame& frame : page.frames)
        json["frames"].push_back(
            {{"name", frame.name},
             {"uri", frame.uri},
             {"note", fmt::format("{}half of the edges within {:.2f} px",
                                  frame.held_out ? "left out; " : "", frame.median_px)},
             {"projection", frame.projection}});
    return json_for_script(json.dump());
}

}  // namespace

std::string spin_page(const SpinPage& page) {
    std::vector<View> rows, facts;
    for (const SpinPage::Row& row : page.proportions)
        rows.push_back({{"name", row.name},
                        {"value", row.value},
                        {"sigma", row.sigma},
                        {"halves", row.halves},
                        {"read", row.read ? "yes" : "no: a guessed facet bounds it"}});
    for (const std::string& fact : page.facts) facts.push_back(View(fact));
    return html_page(page.title, filled(templates::spin, {{"title", page.title},
                                                          {"verdict", page.verdict},
                                                          {"player_json", player_json(page)},
                                                          {"rows", rows},
                                                          {"facts", facts},
                                                          {"beside", page.beside_uri},
                                                          {"version", page.version}}));
}

}  // namespace culet
