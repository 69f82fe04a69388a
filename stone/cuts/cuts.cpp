#include "stone/cuts/cuts.h"

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <glm/geometric.hpp>

#include "stone/cuts/brilliant.h"
#include "stone/cuts/faceted.h"
#include "stone/numbers/units.h"
#include "stone/text/errors.h"
#include "stone/text/name_suggestions.h"
#include "stone/text/toml_file.h"

namespace culet {

namespace {

using Values = std::map<std::string, double>;

const CutParameter k_azimuth{"azimuth", 0,     -360,
                             360,       "deg", "turns the stone about its axis, counter-clockwise"};
const CutParameter k_girdle{"girdle", 3.5, 0.1, 20, "%", "girdle thickness, of the width"};

// With one girdle facet per half the girdle has even thickness; with more it follows the circle and
// shows the trade's scallops, and `girdle` is its thickness at the mains.
const CutParameter k_girdle_segments{
    "girdle-segments", 1, 1, 16, "", "girdle facets under each upper half; 2 and more: scallops"};

std::vector<CutParameter> brilliant_parameters(std::vector<CutParameter> first, double table,
                                               double crown_deg, double pavilion_deg, double star,
                                               double lower_half) {
    const std::vector<CutParameter> rest{
        {"table", table, 20, 90, "%", "table, corner to corner over the mains, of the outline"},
        {"crown-angle", crown_deg, 5, 70, "deg", "crown mains, across the width"},
        {"pavilion-angle", pavilion_deg, 10, 75, "deg", "pavilion mains, across the width"},
        {"star", star, 1, 99, "%",
         "star's end, from where the crown mains meet (0) to the girdle (100), seen from above"},
        {"lower-half", lower_half, 10, 95, "%",
         "lower half length, of the way from girdle to culet"},
        k_girdle,
        {"culet", 0, 0, 15, "%", "culet facet, of the outline; 0 is a point"},
        k_azimuth};
    first.insert(first.end(), rest.begin(), rest.end());
    return first;
}

CutParameter length_width(double ratio, double least = 1) {
    return {"ratio", ratio, least, 3, "", "length over width"};
}
CutParameter width_parameter() {
    return {"width", 5, 1e-3, 1e4, "mm", "width, along y"};
}

// Angles are those at the ends of the width, as a goniometer across the stone measures them.
BrilliantProportions proportions_of(const Values& v, double width) {
    BrilliantProportions p;
    p.table = v.at("table") / 100;
    p.crown_height = 0.5 * width * (1 - p.table) * std::tan(radians(v.at("crown-angle")));
    p.pavilion_depth = 0.5 * width * std::tan(radians(v.at("pavilion-angle")));
    p.girdle = width * v.at("girdle") / 100;
    p.star = v.at("star") / 100;
    p.lower_half = v.at("lower-half") / 100;
    p.culet = v.at("culet") / 100;
    return p;
}

void require_rising_steps(const Values& v, const std::string& part) {
    const double angle = v.at(part + "-angle"), spread = v.at(part + "-spread");
    if (!(angle - spread >= 1)) {
        throw InputError(fmt::format(
            "--{0}-spread {1}: the flattest step would stand at {2:.4g} degrees; with --{0}-angle "
            "{3} expected at most {4:.4g} deg",
            part, spread, angle - spread, angle, angle - 1));
    }
}

std::vector<StepTier> crown_tiers(const Values& v, double height) {
    const double angle = v.at("crown-angle"), spread = v.at("crown-spread");
    return {{radians(angle + spread), 0.45 * height},
            {radians(angle), 0.33 * height},
            {radians(angle - spread), 0.22 * height}};
}

Solid step_of(const Values& v) {
    require_rising_steps(v, "crown");
    require_rising_steps(v, "pavilion");
    StepProportions p;
    p.width = v.at("width");
    p.length = p.width * v.at("ratio");
    p.corner = p.width * v.at("corner") / 100;
    p.girdle = p.width * v.at("girdle") / 100;
    const auto unit = crown_tiers(v, 1);
    double inset = 0;
    for (const StepTier& tier : unit) inset += tier.height / std::tan(tier.angle);
    p.crown = crown_tiers(v, 0.5 * p.width * (1 - v.at("table") / 100) / inset);
    // The steps take 30, 30 and 40 % of the way to the keel.
    const double share[] = {0.3, 0.3, 0.4};
    for (int t = 0; t < 3; ++t) {
        const double angle = radians(v.at("pavilion-angle") + (1 - t) * v.at("pavilion-spread"));
        p.pavilion.push_back({angle, 0.5 * p.width * share[t] * std::tan(angle)});
    }
    return step_cut(p);
}

Solid princess_of(const Values& v) {
    PrincessProportions p;
    p.width = v.at("width");
    p.length = p.width * v.at("ratio");
    p.table = v.at("table") / 100;
    p.girdle = p.width * v.at("girdle") / 100;
    p.crown_height = p.width * v.at("crown-height") / 100;
    p.pavilion_depth = p.width * v.at("pavilion-depth") / 100;
    p.chevrons = static_cast<int>(v.at("chevrons"));
    return princess_cut(p);
}

// Round stones and their stretched images measure the star as the trade does (star_of_length).
std::vector<CutParameter> with_star_length(std::vector<CutParameter> parameters) {
    for (CutParameter& p : parameters) {
        if (p.name == "star")
            p.what = "star length, of the way from the table's edge to the girdle";
    }
    return parameters;
}

struct Recipe {
    CutKind kind;
    std::function<Solid(const Values&)> make;
};

std::vector<CutParameter> round_parameters() {
    auto list = with_star_length(brilliant_parameters(
        {{"diameter", 6.5, 1e-3, 1e4, "mm", "over opposite mains"}}, 57, 34.5, 40.75, 50, 77));
    list.push_back({"mains", 8, 4, 24, "", "mains on crown and pavilion"});
    list.push_back(k_girdle_segments);
    return list;
}

const std::vector<Recipe>& recipes() {
    static const std::vector<Recipe> all{
        {{"round-brilliant", "57 facets and a faceted girdle (Tolkowsky 1919 and after)",
          round_parameters()},
         [](const Values& v) {
             const double d = v.at("diameter");
             const int mains = static_cast<int>(v.at("mains"));
             BrilliantProportions p = proportions_of(v, d);
             p.star = star_of_length(p.star, p.table, mains);
             return brilliant(
                 ellipse_outline(d, d, mains, static_cast<int>(v.at("girdle-segments"))), p);
         }},
        {{"step",
          "emerald cut: eight sides, three crown and three pavilion steps, a keel",
          {width_parameter(),
           length_width(1.4),
           {"corner", 25, 1, 45, "%", "what each corner takes of its sides, of the width"},
           {"table", 60, 20, 90, "%", "table, across the width"},
           {"crown-angle", 37, 10, 65, "deg", "of the middle crown step"},
           {"crown-spread", 9, 0.5, 20, "deg", "between crown steps"},
           {"pavilion-angle", 47, 15, 70, "deg", "of the middle pavilion step"},
           {"pavilion-spread", 8, 0.5, 15, "deg", "between pavilion steps"},
           k_girdle,
           k_azimuth}},
         step_of},
        {{"princess",
          "a square with sharp corners: chevrons that fan out from them",
          {width_parameter(),
           length_width(1),
           {"table", 68, 30, 90, "%", "table, across the width"},
           {"crown-height", 11, 2, 30, "%", "of the width"},
           {"pavilion-depth", 58, 20, 90, "%", "of the width"},
           {"chevrons", 3, 2, 6, "", "steps of the pavilion"},
           k_girdle,
           k_azimuth}},
         princess_of},
        {{"oval", "a round brilliant stretched along its length",
          with_star_length(brilliant_parameters(
              {width_parameter(), length_width(1.35), k_girdle_segments}, 57, 35, 41, 50, 77))},
         [](const Values& v) {
             const double w = v.at("width");
             BrilliantProportions p = proportions_of(v, w);
             p.star = star_of_length(p.star, p.table, 8);
             return brilliant(ellipse_outline(w * v.at("ratio"), w, 8,
                                              static_cast<int>(v.at("girdle-segments"))),
                              p);
         }},
        {{"marquise", "two arcs that meet in points",
          brilliant_parameters({width_parameter(), length_width(2, 1.05)}, 57, 35, 41, 35, 77)},
         [](const Values& v) {
             const double w = v.at("width");
             return brilliant(marquise_outline(w * v.at("ratio"), w), proportions_of(v, w));
         }},
        {{"pear", "a half circle and a point",
          brilliant_parameters({width_parameter(), length_width(1.5, 1.05)}, 57, 35, 41, 35, 77)},
         [](const Values& v) {
             const double w = v.at("width");
             return brilliant(pear_outline(w * v.at("ratio"), w), proportions_of(v, w));
         }},
        {{"trillion", "a triangle with curved sides, six mains",
          brilliant_parameters(
              {width_parameter(), {"bulge", 10, 3, 25, "%", "of the sides, of their length"}}, 57,
              35, 41, 35, 70)},
         [](const Values& v) {
             const double w = v.at("width");
             // Mains stand on sides and corners; the angles are those on the sides.
             const Outline outline = trillion_outline(w, v.at("bulge") / 100);
             return brilliant(outline, proportions_of(v, 2 * glm::length(outline.mains[1])));
         }},
        {{"cushion", "a rounded rectangle",
          brilliant_parameters(
              {width_parameter(),
               length_width(1.1),
               {"squareness", 2.8, 2.05, 4, "", "exponent of the outline; 2 is an oval"}},
              60, 36, 41, 35, 77)},
         [](const Values& v) {
             const double w = v.at("width");
             return brilliant(cushion_outline(w * v.at("ratio"), w, v.at("squareness")),
                              proportions_of(v, w));
         }},
        {{"heart", "two lobes with a notch, and a point; not convex",
          brilliant_parameters({width_parameter(), {"ratio", 1, 0.8, 1.4, "", "length over width"}},
                               55, 34, 41, 35, 70),
          false},
         [](const Values& v) {
             const double w = v.at("width");
             if (v.at("culet") > 0)
                 throw InputError("a heart is cut with a pointed culet here: leave --culet at 0");
             return brilliant(heart_outline(w * v.at("ratio"), w), proportions_of(v, w));
         }},
    };
    return all;
}

const Recipe& recipe(const std::string& name) {
    for (const Recipe& r : recipes()) {
        if (r.kind.name == name || (name == "emerald" && r.kind.name == "step")) return r;
    }
    std::vector<std::string> names{"emerald"};
    for (const Recipe& r : recipes()) names.push_back(r.kind.name);
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
        for (const Recipe& r : recipes()) list.push_back(r.kind);
        return list;
    }();
    return kinds;
}

const CutKind& cut_kind(const std::string& name) {
    return recipe(name).kind;
}

Solid make_cut(const std::string& name, const std::map<std::string, double>& values) {
    const Recipe& r = recipe(name);
    Values all;
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
