#include "viewer/engine/viewer_document.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "page/html.h"
#include "stone/text/errors.h"
#include "viewer/engine/stone_json.h"

namespace culet {

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* k_schema = "culet-view-1";

void put(Json& json, const char* key, const std::optional<double>& value) {
    json[key] = value && std::isfinite(*value) ? Json(*value) : Json();
}
std::optional<double> number_in(const Json& json, const char* key) {
    const auto found = json.find(key);
    if (found == json.end() || !found->is_number()) return std::nullopt;
    return found->get<double>();
}

Json json_of(const FacetFacts& facts) {
    Json json = Json::object();
    put(json, "inclination_deg", facts.inclination_deg);
    put(json, "azimuth_deg", facts.azimuth_deg);
    put(json, "inclination_sigma_deg", facts.inclination_sigma_deg);
    put(json, "azimuth_sigma_deg", facts.azimuth_sigma_deg);
    put(json, "direction_sigma_deg", facts.direction_sigma_deg);
    put(json, "residual", facts.residual);
    json["reading"] = facts.reading;
    json["readings"] = facts.readings;
    json["suspect"] = facts.suspect;
    json["determined"] = facts.determined;
    return json;
}

FacetFacts facts_from(const Json& json) {
    FacetFacts facts;
    facts.inclination_deg = number_in(json, "inclination_deg");
    facts.azimuth_deg = number_in(json, "azimuth_deg");
    facts.inclination_sigma_deg = number_in(json, "inclination_sigma_deg");
    facts.azimuth_sigma_deg = number_in(json, "azimuth_sigma_deg");
    facts.direction_sigma_deg = number_in(json, "direction_sigma_deg");
    facts.residual = number_in(json, "residual");
    facts.reading = json.value("reading", "");
    facts.readings = json.value("readings", 0);
    facts.suspect = json.value("suspect", false);
    facts.determined = json.value("determined", true);
    return facts;
}

ViewItem item_from(const Json& json) {
    ViewItem item;
    item.name = json.at("name");
    for (const Json& stone : json.at("stones")) item.stones.push_back(stone_from(stone));
    item.scene = json.at("scene");
    for (const auto& [name, text] : json.at("files").items()) {
        auto bytes = bytes_of_base64(text.get<std::string>());
        if (!bytes) throw InputError(fmt::format("the page's file {} is broken", name));
        item.files[name] = std::move(*bytes);
    }
    item.picture = json.value("picture", "");
    item.refused = json.value("refused", "");
    item.command = json.value("command", "");
    return item;
}

}  // namespace

Json json_of(const Vec3& v) {
    return Json::array({v.x, v.y, v.z});
}

Vec3 vector_from(const Json& json) {
    const auto values = json.get<std::array<double, 3>>();
    return {values[0], values[1], values[2]};
}

Json json_of(const ViewedStone& viewed) {
    const Stone& stone = viewed.stone;
    Json vertices = Json::array(), facets = Json::array(), crystal = Json::array();
    for (const Vec3& v : stone.solid.vertices) vertices.push_back(json_of(v));
    for (const Facet& facet : stone.solid.facets) {
        facets.push_back({{"name", facet.name},
                          {"normal", json_of(facet.plane.normal)},
                          {"offset", facet.plane.offset},
                          {"corners", facet.corners}});
    }
    for (const Vec3& axis : stone.crystal.axes) crystal.push_back(json_of(axis));
    Json json{
        {"role", viewed.role},     {"name", stone.name}, {"unit", name_of(stone.unit)},
        {"vertices", vertices},    {"facets", facets},   {"convex", stone.convex},
        {"up", json_of(stone.up)}, {"crystal", crystal}, {"material", json_of(stone.material)}};
    if (viewed.cut) json["cut"] = {{"kind", viewed.cut->kind}, {"values", viewed.cut->values}};
    if (!viewed.fit.empty()) {
        Json fit = Json::array();
        for (const FacetFacts& facts : viewed.fit) fit.push_back(json_of(facts));
        json["fit"] = fit;
    }
    return json;
}

ViewedStone stone_from(const Json& json) {
    ViewedStone viewed;
    viewed.role = json.at("role");
    Stone& stone = viewed.stone;
    stone.name = json.at("name");
    const auto unit = length_unit(json.at("unit").get<std::string>());
    if (!unit) throw InputError("the page's document has a stone of an unknown unit");
    stone.unit = *unit;
    for (const Json& vertex : json.at("vertices"))
        stone.solid.vertices.push_back(vector_from(vertex));
    for (const Json& facet : json.at("facets")) {
        stone.solid.facets.push_back({facet.at("name").get<std::string>(),
                                      {vector_from(facet.at("normal")), facet.at("offset")},
                                      facet.at("corners").get<std::vector<int>>()});
    }
    stone.convex = json.at("convex");
    stone.up = vector_from(json.at("up"));
    for (std::size_t i = 0; i < 3; ++i)
        stone.crystal.axes[i] = vector_from(json.at("crystal").at(i));
    stone.material = material_from(json.at("material"));
    stone.facets_are_whole = true;
    if (json.contains("cut")) {
        viewed.cut = CutChoice{json.at("cut").at("kind"),
                               json.at("cut").at("values").get<std::map<std::string, double>>()};
    }
    if (json.contains("fit")) {
        for (const Json& facts : json.at("fit")) viewed.fit.push_back(facts_from(facts));
    }
    return viewed;
}

Json json_of(const ViewItem& item) {
    Json stones = Json::array(), files = Json::object();
    for (const ViewedStone& stone : item.stones) stones.push_back(json_of(stone));
    for (const auto& [name, bytes] : item.files) files[name] = base64(bytes);
    return {{"name", item.name},      {"stones", stones},        {"scene", item.scene},
            {"files", files},         {"picture", item.picture}, {"refused", item.refused},
            {"command", item.command}};
}

std::string document_json(const ViewDocument& document) {
    Json items = Json::array();
    for (const ViewItem& item : document.items) items.push_back(json_of(item));
    const Json json{{"schema", k_schema},
                    {"title", document.title},
                    {"version", document.version},
                    {"first", document.first},
                    {"items", items}};
    return json.dump();
}

ViewItem read_view_item(std::string_view document, int item) {
    try {
        const Json json = Json::parse(document);
        if (json.value("schema", "") != k_schema)
            throw InputError(fmt::format("the page's document is no {}", k_schema));
        const Json& items = json.at("items");
        if (item < 0 || item >= static_cast<int>(items.size()))
            throw InputError(fmt::format("the page has {} stones, counted from 0, found {}",
                                         items.size(), item));
        return item_from(items.at(static_cast<std::size_t>(item)));
    } catch (const Json::exception& error) {
        throw InputError(fmt::format("the page's document is broken: {}", error.what()));
    }
}

}  // namespace culet
