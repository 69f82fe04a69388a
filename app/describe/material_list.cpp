#include "app/describe/material_list.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "page/material_page.h"
#include "render/colour/material_colour.h"
#include "stone/material/material.h"
#include "stone/text/errors.h"
#include "stone/text/output_file.h"
#include "stone/text/text_scan.h"

namespace culet {

namespace {

using Json = nlohmann::ordered_json;

double birefringence(const Material& material) {
    double least = material.index[0].at(k_d_line_nm), largest = least;
    for (int ray = 1; ray < ray_count(material.optic); ++ray) {
        const double n = material.index[ray].at(k_d_line_nm);
        least = std::min(least, n);
        largest = std::max(largest, n);
    }
    return largest - least;
}

Json json_of(const Material& material) {
    Json object{{"id", material.id}, {"name", material.name}};
    for (int ray = 0; ray < ray_count(material.optic); ++ray) {
        object["index_589nm"][ray_name(material.optic, ray)] = material.index[ray].at(k_d_line_nm);
    }
    object["birefringence"] = birefringence(material);
    object["density"] = material.density_g_cm3 ? Json(*material.density_g_cm3) : Json();
    const StoneColour colour = body_colour(material);
    object["colour"] = Json();
    if (material.has_absorption()) {
        object["colour"] = {{"name", colour.name},
                            {"srgb", display_hex(colour.rgb)},
                            {"lab", {colour.lab.L, colour.lab.a, colour.lab.b}}};
    }
    object["usual_colour"] = material.usual_colour.empty() ? Json() : Json(material.usual_colour);
    object["confidence"] = material.confidence;
    object["source"] = material.source;
    object["absorption_confidence"] = material.absorption_confidence;
    object["absorption_source"] = material.absorption_source;
    object["absorption_depth"] = material.absorption_depth;
    return object;
}

std::string colour_words(const Material& material, const StoneColour& colour) {
    if (material.has_absorption()) return colour.name;
    if (material.usual_colour.empty()) return "colourless";
    return "no spectrum, drawn colourless; usually " + material.usual_colour;
}

void print_row(const Material& material, bool swatches) {
    std::string indices;
    for (int ray = 0; ray < ray_count(material.optic); ++ray) {
        indices +=
            fmt::format("{}{:.3f}", ray == 0 ? "" : " ", material.index[ray].at(k_d_line_nm));
    }
    const double split = birefringence(material);
    const StoneColour colour = body_colour(material);
    std::string swatch;
    if (swatches) {
        const auto [red, green, blue] = display_colour(colour.rgb);
        swatch = material.has_absorption()
                     ? fmt::format("\033[48;2;{};{};{}m    \033[0m ", red, green, blue)
                     : "     ";
    }
    fmt::print("{:<20} {:<18}{:>6} {:>6}  {}{}\n", material.id, indices,
               split > 0 ? fmt::format("{:.3f}", split) : "-",
               material.density_g_cm3 ? fmt::format("{:.2f}", *material.density_g_cm3) : "-",
               swatch, colour_words(material, colour));
}

}  // namespace

void list_materials(const MaterialList& list) {
    const std::vector<std::string> names =
        list.words.empty() ? catalogue_names() : catalogue_names_like(list.words);
    if (names.empty()) {
        throw InputError(fmt::format(
            "no material of the catalogue is like \"{}\"; culet info --materials lists all of them",
            list.words));
    }
    if (!list.page.empty() && extension_of(list.page) != "html" && extension_of(list.page) != "htm")
        throw InputError(list.page, "the list of materials is written as a page: name it .html");
    require_writable(list.json);
    require_writable(list.page);
    Json object{{"schema", 1},
                {"width_mm", k_usual_width_mm},
                {"light_path_mm", light_path_mm(k_usual_width_mm)},
                {"light", "D65"},
                {"observer", "CIE 1931 2 degrees"}};
    object["materials"] = Json::array();
    for (const std::string& name : names)
        object["materials"].push_back(json_of(catalogue_material(name)));
    const std::string json = object.dump(2) + "\n";
    if (!list.json.empty()) write_text(list.json, json);
    if (!list.page.empty()) write_text(list.page, material_page(json, CULET_VERSION));
    if (list.json == "-") return;
    const bool swatches = isatty(STDOUT_FILENO) != 0 && std::getenv("NO_COLOR") == nullptr;
    fmt::print("{:<20} {:<18}{:>6} {:>6}  {}\n", "name", "index (589 nm)", "biref.", "g/cm3",
               "colour of a brilliant of 6.5 mm");
    for (const std::string& name : names) print_row(catalogue_material(name), swatches);
    std::fflush(stdout);
}

}  // namespace culet
