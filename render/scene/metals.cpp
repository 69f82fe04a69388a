#include "render/scene/metals.h"

#include <fmt/format.h>

#include "stone/text/errors.h"
#include "stone/text/name_suggestions.h"
#include "stone/text/toml_file.h"

namespace culet {

const std::vector<Metal>& metals() {
    static const std::vector<Metal> list{
        {"gold", {1.000, 0.782, 0.344}},      {"white-gold", {0.733, 0.697, 0.652}},
        {"rose-gold", {0.979, 0.730, 0.460}}, {"silver", {0.972, 0.960, 0.915}},
        {"platinum", {0.673, 0.637, 0.585}},
    };
    return list;
}

const Metal& metal_named(std::string_view name) {
    std::vector<std::string> names;
    std::string known;
    for (const Metal& metal : metals()) {
        if (metal.name == name) return metal;
        names.emplace_back(metal.name);
        known += (known.empty() ? "" : ", ") + names.back();
    }
    const auto near = nearest_name(name, names);
    throw InputError(fmt::format("no metal \"{}\"{}; known: {}", name,
                                 near ? fmt::format(", did you mean {}?", *near) : "", known));
}

}  // namespace culet
