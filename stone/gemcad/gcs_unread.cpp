#include "stone/gemcad/gcs_unread.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <vector>

#include "stone/text/errors.h"
#include "stone/text/text_scan.h"

namespace culet {

namespace {

using Words = std::vector<std::string_view>;

const Words k_elements{"index", "tier", "render", "info", "facet", "vertex", "color"};
const Words k_of_tier{"angle", "depth", "name", "instructions", "visible", "guide", "frosting"};
const Words k_of_facet{"nx", "ny", "nz", "index_angle", "frosting"};
const Words k_of_vertex{"x", "y", "z"};
// No published file has them. Whoever adds curved tiers will hardly do without these words.
const Words k_curved{"concave", "convex", "curv", "cylind", "radius", "diameter", "groove", "cone"};

bool holds(const Words& words, std::string_view word) {
    return std::find(words.begin(), words.end(), word) != words.end();
}

bool is_off(const std::string& value) {
    return holds({"", "0", "false", "no", "none", "flat"}, value) || number_in(value) == 0.0;
}

class Search {
public:
    void look_at(const pugi::xml_node& node, const pugi::xml_node& tier) {
        const std::string_view name = node.name();
        if (!holds(k_elements, name)) {
            add(found.elements, fmt::format("<{}>", shown(name)));
            if (is_curved(name)) curve(tier, fmt::format("<{}>", shown(name)));
        }
        const Words* known = name == "tier"     ? &k_of_tier
                             : name == "facet"  ? &k_of_facet
                             : name == "vertex" ? &k_of_vertex
                                                : nullptr;
        for (const pugi::xml_attribute own : node.attributes()) {
            if (known == nullptr || holds(*known, own.name())) continue;
            add(found.attributes, fmt::format("{} of <{}>", shown(own.name()), name));
            if (is_curved(own.name()) && !is_off(lower_case(std::string(trimmed(own.value())))))
                curve(tier, fmt::format("{}=\"{}\"", shown(own.name()), shown(own.value())));
        }
    }
    GcsUnread found;

private:
    static bool is_curved(std::string_view name) {
        const std::string word = lower_case(std::string(name));
        return std::any_of(k_curved.begin(), k_curved.end(), [&](std::string_view part) {
            return word.find(part) != std::string::npos;
        });
    }
    void curve(const pugi::xml_node& tier, const std::string& words) {
        if (!tier || found.curved) return;
        found.curved = tier;
        found.curved_by = words;
    }
    static void add(std::string& list, const std::string& name) {
        if ((", " + list + ", ").find(", " + name + ", ") == std::string::npos)
            list += (list.empty() ? "" : ", ") + name;
    }
};

}  // namespace

GcsUnread gcs_unread(const pugi::xml_node& root) {
    Search search;
    for (const pugi::xml_node node : root.children()) {
        if (node.type() != pugi::node_element) continue;
        const bool is_tier = std::string_view(node.name()) == "tier";
        const std::string visible = lower_case(node.attribute("visible").value());
        const pugi::xml_node cut =
            is_tier && visible != "false" && visible != "0" ? node : pugi::xml_node();
        search.look_at(node, cut);
        if (!is_tier) continue;
        for (const pugi::xml_node part : node.children()) {
            if (part.type() != pugi::node_element) continue;
            search.look_at(part, cut);
            for (const pugi::xml_node corner : part.children()) {
                if (corner.type() == pugi::node_element) search.look_at(corner, cut);
            }
        }
    }
    return std::move(search.found);
}

}  // namespace culet
