#include "stone/cuts/cuts.h"

#include <fmt/format.h>

#include <cmath>

#include "stone/cuts/recipes.h"
#include "stone/numbers/units.h"
#include "stone/text/errors.h"
#include "stone/text/name_suggestions.h"

namespace culet {

namespace {

const CutRecipe& recipe(const std::string& name) {
    for (const CutRecipe& r : cut_recipes()) {
        if (r.kind.name == name || (name == "emerald" && r.kind.name == "step")) return r;
    }
    std::vector<std::string> names{"emerald"};
    for (const CutRecipe& r : cut_recipes()) names.push_back(r.kind.name);
    const std::vector<std::string> like = names_like(name, names);
    throw InputError(
        fmt::format("no cut \"{}\"{}; culet cut --list lists them", name,
                    like.empty() ? "" : fmt::format(", did you mean {}?", listed(like))));
}

void turn(Solid& solid, double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    const auto turned = [c, s](const Vec3& v) {
        return Vec3{c * v.x - s * v.y, s * v.x + c * v.y, v.z};
    };
    for (Vec3& v : solid.vertices) v = turned(v);
    for (Facet& facet : solid.facets) facet.plane.normal = turned(facet.plane.normal);
}

}  // namespace

const std::vector<CutKind>& cut_kinds() {
    static const std::vector<CutKind> kinds = [] {
        std::vector<CutKind> list;
        for (const CutRecipe& r : cut_recipes()) list.push_back(r.kind);
        return list;
    }();
    return kinds;
}

const CutKind& cut_kind(const std::string& name) {
    return recipe(name).kind;
}

Solid make_cut(const std::string& name, const std::map<std::string, double>& values) {
    const CutRecipe& r = recipe(name);
    CutValues all;
    std::vector<std::string> names;
    for (const CutParameter& parameter : r.kind.parameters) {
        all[parameter.name] = parameter.value;
        names.push_back(parameter.name);
    }
    for (const auto& [key, value] : values) {
        if (all.count(key) == 0) {
            const auto near = nearest_name(key, names);
            throw InputError(
                fmt::format("the cut {} has no parameter \"{}\"{}", r.kind.name, key,
                            near ? fmt::format(", did you mean \"{}\"?", *near) : std::string()));
        }
        all[key] = value;
    }
    for (const CutParameter& parameter : r.kind.parameters) {
        const double value = all[parameter.name];
        if (!(value >= parameter.least && value <= parameter.most)) {
            throw InputError(fmt::format("--{} {}: expected {} to {} {}", parameter.name, value,
                                         parameter.least, parameter.most, parameter.unit));
        }
        const bool whole = parameter.name == "mains" || parameter.name == "chevrons" ||
                           parameter.name == "girdle-segments";
        if (whole && value != std::floor(value)) {
            throw InputError(
                fmt::format("--{} {}: expected a whole number", parameter.name, value));
        }
    }
    Solid solid = r.make(all);
    if (all["azimuth"] != 0) turn(solid, radians(all["azimuth"]));
    return solid;
}

}  // namespace culet
