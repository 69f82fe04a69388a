// Writes Gem Cut Studio's .gcs, in ASCII: the program takes other bytes for Windows-1252.

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <pugixml.hpp>
#include <sstream>

#include "stone/gemcad/cut_text.h"
#include "stone/gemcad/gcs_words.h"
#include "stone/text/text_decoding.h"

namespace culet {

namespace {

using Node = pugi::xml_node;

void set(Node node, const char* key, const std::string& value) {
    if (!node.attribute(key)) node.append_attribute(key) = value.c_str();
}

void set(Node node, const char* key, double value) {
    set(node, key, fmt::format("{}", value + 0.0));
}

// What a .gcs gave of this element, and the design keeps.
void keep(const Design& design, Node node) {
    const std::string of = std::string(node.name()) + ".";
    for (const auto& [key, value] : design.studio) {
        if (key.starts_with(of)) set(node, key.substr(of.size()).c_str(), value);
    }
}

void add_facet(Node tier, const CutLine& line, std::size_t i, const Solid& solid,
               const Design& design) {
    const Vec3 normal = line.plane(i, solid, design).normal, turned = gcs_turned(normal);
    Node facet = tier.append_child("facet");
    set(facet, "nx", turned.x);
    set(facet, "ny", turned.y);
    set(facet, "nz", turned.z);
    set(facet, "index_angle", gcs_index_angle(normal));
    if (line.tier != nullptr && line.tier->frosting > 0)
        set(facet, "frosting", line.tier->frosting);
    if (line.facets[i] < 0) return;
    for (const int corner : solid.facets[std::size_t(line.facets[i])].corners) {
        const Vec3 v = gcs_turned(solid.vertices[std::size_t(corner)]);
        Node vertex = facet.append_child("vertex");
        set(vertex, "x", v.x);
        set(vertex, "y", v.y);
        set(vertex, "z", v.z);
    }
}

// One name a tier, which may take several lines.
std::string name_of(const CutLine& line, const Design& design,
                    const std::vector<std::string>& titles) {
    const auto labelled = [](const DesignFacet& facet) { return !facet.label.empty(); };
    if (line.tier != nullptr) {
        const std::vector<DesignFacet>& facets = line.tier->facets;
        if (std::none_of(facets.begin(), facets.end(), labelled)) return {};
        return titles[std::size_t(line.tier - design.tiers.data())];
    }
    const auto label = std::find_if(line.labels.begin(), line.labels.end(),
                                    [](const std::string& own) { return !own.empty(); });
    return label == line.labels.end() ? std::string() : *label;
}

void add_tier(Node root, const CutLine& line, const std::string& name, const Solid& solid,
              const Design& design) {
    const CutSetting& cut = line.setting;
    const DesignTier tier = line.tier == nullptr ? DesignTier() : *line.tier;
    Node node = root.append_child("tier");
    set(node, "angle", cut.pavilion ? 180 - cut.angle_deg : cut.angle_deg);
    set(node, "depth", cut.distance);
    set(node, "name", name);
    set(node, "instructions", line.ends_tier ? tier.instruction : "");
    set(node, "visible", std::string(tier.hidden ? "false" : "true"));
    set(node, "guide", std::string(tier.guide ? "true" : "false"));
    // The reader names the first facet as the tier.
    std::vector<std::size_t> order(line.facets.size());
    std::iota(order.begin(), order.end(), 0u);
    std::stable_partition(order.begin(), order.end(),
                          [&](std::size_t i) { return !line.labels[i].empty(); });
    for (const std::size_t i : order) add_facet(node, line, i, solid, design);
}

template <class Keys>
void add_lines(Node info, const Keys& keys, const std::vector<std::string>& lines) {
    for (std::size_t k = 0; k < std::min(keys.size(), lines.size()); ++k) {
        std::string text = lines[k];
        for (std::size_t more = keys.size(); k + 1 == keys.size() && more < lines.size(); ++more)
            text += "\n" + lines[more];
        set(info, keys[k], text);
    }
}

std::string in_ascii(const std::string& xml) {
    std::string out;
    for (std::size_t at = 0; at < xml.size();) {
        const std::int32_t code = next_code_point(xml, at);
        if (code < 0x80) {
            out.push_back(code < 0 ? '_' : char(code));
        } else {
            out += fmt::format("&#{};", code);
        }
    }
    return out;
}

}  // namespace

std::string gcs_text(const Solid& solid, const Design& design, const std::vector<CutLine>& lines) {
    pugi::xml_document document;
    Node root = document.append_child("GemCutStudio");
    set(root, "version", 1000);
    Node index = root.append_child("index");
    set(index, "gear", std::abs(design.gear));
    keep(design, index);
    set(index, "base", 0);
    set(index, "symmetry", design.symmetry);
    set(index, "mirror", 0);
    const std::vector<std::string> titles = tier_titles(design);
    for (const CutLine& line : lines)
        add_tier(root, line, name_of(line, design, titles), solid, design);
    Node render = root.append_child("render"), colour = render.append_child("color");
    keep(design, render);
    keep(design, colour);
    if (design.refractive_index) set(render, "refractive_index", *design.refractive_index);
    if (!colour.first_attribute()) render.remove_child(colour);
    if (!render.first_attribute() && !render.first_child()) root.remove_child(render);
    Node info = root.append_child("info");
    add_lines(info, k_gcs_headings, design.headings);
    add_lines(info, k_gcs_footnotes, design.footnotes);
    keep(design, info);
    if (!info.first_attribute()) root.remove_child(info);
    std::ostringstream out;
    document.save(out, "  ", pugi::format_indent | pugi::format_no_declaration,
                  pugi::encoding_utf8);
    return in_ascii(out.str());
}

}  // namespace culet
