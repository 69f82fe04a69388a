#include "page/material_page.h"

#include <nlohmann/json.hpp>

#include "page/html.h"
#include "page/json_fields.h"
#include "page/parts.h"
#include "page/templates.h"

namespace culet {

namespace {

using OrderedJson = nlohmann::ordered_json;  // keeps the order of the rays

std::string lab_of(const OrderedJson& colour) {
    std::string lab;
    for (const OrderedJson& value : array_at(colour, "lab")) {
        if (value.is_number()) lab += (lab.empty() ? "" : ", ") + decimals(value.get<double>(), 0);
    }
    return lab;
}

std::vector<View> indices_of(const OrderedJson& material) {
    std::vector<View> list;
    const auto indices = material.find("index_589nm");
    if (indices == material.end() || !indices->is_object()) return list;
    for (const auto& [ray, n] : indices->items()) {
        if (!n.is_number()) continue;
        list.push_back({{"further", !list.empty()},
                        {"ray", ray == "n" ? std::string() : ray},
                        {"n", decimals(n.get<double>(), 3)}});
    }
    return list;
}

View material_row(const OrderedJson& material) {
    const auto found = material.find("colour");
    const OrderedJson colour =
        found != material.end() && found->is_object() ? *found : OrderedJson(OrderedJson::object());
    return {{"id", text_at(material, "id")},
            {"name", text_at(material, "name")},
            {"coloured", !colour.empty()},
            {"swatch", text_at(colour, "srgb")},
            {"colour", text_at(colour, "name")},
            {"lab", lab_of(colour)},
            {"usual", text_at(material, "usual_colour")},
            {"indices", indices_of(material)},
            {"birefringence", decimals(number_at(material, "birefringence"), 3)},
            {"density", decimals(number_at(material, "density"), 2)},
            {"source", text_at(material, "source")},
            {"absorption_source", text_at(material, "absorption_source")},
            {"confidence", text_at(material, "absorption_confidence")},
            {"depth", text_at(material, "absorption_depth")}};
}

}  // namespace

std::string material_page(const std::string& text, const std::string& version) {
    const OrderedJson json = parsed_object<OrderedJson>(text, "the list of materials");
    std::vector<View> rows;
    for (const OrderedJson& material : array_at(json, "materials"))
        rows.push_back(material_row(material));
    return html_page(
        "Materials",
        filled(templates::materials, {{"version", version},
                                      {"path_mm", decimals(number_at(json, "light_path_mm"), 1)},
                                      {"width_mm", significant(number_at(json, "width_mm"))},
                                      {"tall", is_tall(rows)},
                                      {"rows", rows}}),
        text);
}

}  // namespace culet
