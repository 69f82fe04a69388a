// A stone file for a mesh and its form.

#include <fmt/format.h>

#include "fit/readings/readings_template.h"
#include "stone/numbers/units.h"

namespace culet {

namespace {

std::string toml_text(const std::string& text) {
    std::string quoted_text = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') quoted_text += '\\';
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
            quoted_text += fmt::format("\\u{:04x}", static_cast<unsigned char>(c));
        } else {
            quoted_text += c;
        }
    }
    return quoted_text + "\"";
}

std::string seen_from(const std::filesystem::path& file, const std::filesystem::path& target) {
    const std::filesystem::path folder = std::filesystem::absolute(file).parent_path();
    return std::filesystem::absolute(target).lexically_proximate(folder).generic_string();
}

}  // namespace

std::string stone_file_text(const Stone& stone, const std::filesystem::path& file,
                            const std::filesystem::path& mesh,
                            const std::filesystem::path& readings, const std::string& material,
                            const std::string& up_facet) {
    std::string text =
        fmt::format("[stone]\nname = {}\nmesh = {}\nunit = \"{}\"\n", toml_text(stone.name),
                    toml_text(seen_from(file, mesh)), name_of(stone.unit));
    if (material.empty()) {
        text +=
            "# material = \"diamond\"   # a name that culet info --materials lists; or density = "
            "3.52, g/cm3: a weight needs one of them\n";
    } else {
        text += fmt::format("material = {}\n", toml_text(material));
    }
    if (!up_facet.empty()) {
        text += fmt::format("up = {}   # inclinations count from this facet, the table\n",
                            toml_text(up_facet));
    }
    if (!stone.convex) text += "convex = false\n";
    text += "azimuth_zero = \"mesh\"   # directions of widths count from the mesh's x\n";
    text += fmt::format("readings = {}\n", toml_text(seen_from(file, readings)));
    return text;
}

}  // namespace culet
