#include "render/image/exr_channels.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <vector>

#include "stone/text/errors.h"

namespace culet {

namespace {

// Maps `red`, `r` and `R` to one name.
std::string base_name(std::string name) {
    std::transform(name.begin(), name.end(), name.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    for (const char* word : {"red", "green", "blue", "alpha"}) {
        if (name == word) return name.substr(0, 1);
    }
    return name;
}

std::string list_of(const std::vector<std::string>& names) {
    std::string list;
    for (std::size_t i = 0; i < names.size() && i < 8; ++i) list += (i > 0 ? ", " : "") + names[i];
    return names.size() > 8 ? list + ", ..." : list.empty() ? "none" : list;
}

// A layer's channels by their base names.
using Layer = std::map<std::string, std::string>;

bool has(const Layer& layer, std::initializer_list<const char*> names) {
    return std::all_of(names.begin(), names.end(),
                       [&](const char* name) { return layer.count(name) > 0; });
}

}  // namespace

ExrColours colours_in(const Imf::ChannelList& channels, const std::filesystem::path& file) {
    std::map<std::string, Layer> layers;
    std::vector<std::string> names, with_colours;
    for (auto c = channels.begin(); c != channels.end(); ++c) {
        const std::string name = c.name();
        const std::size_t dot = name.rfind('.');
        const std::string layer = dot == std::string::npos ? "" : name.substr(0, dot);
        names.push_back(name);
        layers[layer].emplace(base_name(dot == std::string::npos ? name : name.substr(dot + 1)),
                              name);
    }
    for (const auto& [name, layer] : layers) {
        if (!name.empty() && has(layer, {"r", "g", "b"})) with_colours.push_back(name);
    }
    using Kind = ExrColours::Kind;
    const Layer& top = layers[""];
    ExrColours found;
    const auto take = [&](const Layer& layer, std::array<const char*, 3> wanted) {
        for (std::size_t i = 0; i < 3; ++i)
            if (wanted[i] != nullptr) found.names[i] = layer.at(wanted[i]);
        if (layer.count("a") > 0) found.alpha = layer.at("a");
    };
    if (has(top, {"r", "g", "b"})) {
        take(top, {"r", "g", "b"});
    } else if (has(top, {"x", "y", "z"})) {
        found.kind = Kind::xyz;
        take(top, {"x", "y", "z"});
    } else if (has(top, {"y"})) {
        found.kind = has(top, {"ry", "by"}) ? Kind::chroma : Kind::grey;
        take(top, {"y", nullptr, nullptr});
    } else if (with_colours.size() == 1) {
        found.layer = with_colours[0];
        take(layers[found.layer], {"r", "g", "b"});
    } else if (with_colours.empty()) {
        throw InputError(file, fmt::format("is an EXR without R, G, B or Y channels; it has {}",
                                           list_of(names)));
    } else {
        throw InputError(file, fmt::format("is an EXR with colours in {} layers ({}): save the one "
                                           "you want by itself, as R, G, B",
                                           with_colours.size(), list_of(with_colours)));
    }
    return found;
}

}  // namespace culet
