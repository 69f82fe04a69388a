#include "stone/cuts/recipes.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "stone/cuts/brilliant.h"
#include "stone/cuts/faceted.h"
#include "stone/numbers/units.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

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
BrilliantProportions proportions_of(const CutValues& v, double width) {
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

void require_rising_steps(const CutValues& v, const std::string& part) {
    const double angle = v.at(part + "-angle"), spread = v.at(part + "-spread");
    if (!(angle - spread >= 1)) {
        throw InputError(fmt::format(
            "--{0}-spread {1}: the flattest step would stand at {2:.4g} degrees; with --{0}-angle "
            "{3} expected at most {4:.4g} deg",
            part, spread, angle - spread, angle, angle - 1));
    }
}

std::vector<StepTier> crown_tiers(const CutValues& v, double height) {
    const double angle = v.at("crown-angle"), spread = v.at("crown-spread");
    return {{radians(angle + spread), 0.45 * height},
            {radians(angle), 0.33 * height},
            {radians(angle - spread), 0.22 * height}};
}

Solid step_of(const CutValues& v) {
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

Solid princess_of(const CutValues& v) {
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

std::vector<CutParameter> round_parameters() {
    auto list = with_star_length(brilliant_parameters(
        {{"diameter", 6.5, 1e-3, 1e4, "mm", "over opposite mains"}}, 57, 34.5, 40.75, 50, 77));
    list.push_back({"mains", 8, 4, 24, "", "mains on crown and pavilion"});
    list.push_back(k_girdle_segments);
    return list;
}

// A round brilliant, or one stretched along its length.
Solid elliptic_brilliant(const CutValues& v, double length, double width, int mains) {
    BrilliantProportions p = proportions_of(v, width);
    p.star = star_of_length(p.star, p.table, mains);
    return brilliant(
        ellipse_outline(length, width, mains, static_cast<int>(v.at("girdle-segments"))), p);
}

Solid brilliant_in(Outline (*outline)(double length, double width), const CutValues& v) {
    const double w = v.at("width");
    return brilliant(outline(w * v.at("ratio"), w), proportions_of(v, w));
}

std::vector<CutParameter> step_parameters(double ratio, double corner, double crown_deg,
                                          double crown_spread_deg) {
    return {width_parameter(),
            length_width(ratio),
            {"corner", corner, 1, 45, "%", "what each corner takes of its sides, of the width"},
            {"table", 60, 20, 90, "%", "table, across the width"},
            {"crown-angle", crown_deg, 10, 65, "deg", "of the middle crown step"},
            {"crown-spread", crown_spread_deg, 0.5, 20, "deg", "between crown steps"},
            {"pavilion-angle", 47, 15, 70, "deg", "of the middle pavilion step"},
            {"pavilion-spread", 8, 0.5, 15, "deg", "between pavilion steps"},
            k_girdle,
            k_azimuth};
}

const std::vector<CutParameter> k_princess_parameters{
    width_parameter(),
    length_width(1),
    {"table", 68, 30, 90, "%", "table, across the width"},
    {"crown-height", 11, 2, 30, "%", "of the width"},
    {"pavilion-depth", 58, 20, 90, "%", "of the width"},
    {"chevrons", 3, 2, 6, "", "steps of the pavilion"},
    k_girdle,
    k_azimuth};

}  // namespace

const std::vector<CutRecipe>& cut_recipes() {
    static const std::vector<CutRecipe> all{
        {{"round-brilliant", "57 facets and a faceted girdle (Tolkowsky 1919 and after)",
          round_parameters()},
         [](const CutValues& v) {
             const double d = v.at("diameter");
             return elliptic_brilliant(v, d, d, static_cast<int>(v.at("mains")));
         }},
        {{"step", "emerald cut: eight sides, three crown and three pavilion steps, a keel",
          step_parameters(1.4, 25, 37, 9)},
         step_of},
        {{"asscher", "a square step cut with wide corners and a high crown",
          step_parameters(1, 28, 42, 12)},
         step_of},
        {{"princess", "a square with sharp corners: chevrons that fan out from them",
          k_princess_parameters},
         princess_of},
        {{"oval", "a round brilliant stretched along its length",
          with_star_length(brilliant_parameters(
              {width_parameter(), length_width(1.35), k_girdle_segments}, 57, 35, 41, 50, 77))},
         [](const CutValues& v) {
             const double w = v.at("width");
             return elliptic_brilliant(v, w * v.at("ratio"), w, 8);
         }},
        {{"marquise", "two arcs that meet in points",
          brilliant_parameters({width_parameter(), length_width(2, 1.05)}, 57, 35, 41, 35, 77)},
         [](const CutValues& v) { return brilliant_in(marquise_outline, v); }},
        {{"pear", "a half circle and a point",
          brilliant_parameters({width_parameter(), length_width(1.5, 1.05)}, 57, 35, 41, 35, 77)},
         [](const CutValues& v) { return brilliant_in(pear_outline, v); }},
        {{"trillion", "a triangle with curved sides, six mains",
          brilliant_parameters(
              {width_parameter(), {"bulge", 10, 3, 25, "%", "of the sides, of their length"}}, 57,
              35, 41, 35, 70)},
         [](const CutValues& v) {
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
         [](const CutValues& v) {
             const double w = v.at("width");
             return brilliant(cushion_outline(w * v.at("ratio"), w, v.at("squareness")),
                              proportions_of(v, w));
         }},
        {{"heart", "two lobes with a notch, and a point; not convex",
          brilliant_parameters({width_parameter(), {"ratio", 1, 0.8, 1.4, "", "length over width"}},
                               55, 34, 41, 35, 70),
          false},
         [](const CutValues& v) {
             if (v.at("culet") > 0)
                 throw InputError("a heart is cut with a pointed culet here: leave --culet at 0");
             return brilliant_in(heart_outline, v);
         }},
    };
    return all;
}

}  // namespace culet
