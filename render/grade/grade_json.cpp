#include "render/grade/grade_json.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "render/grade/grade_figures.h"
#include "stone/numbers/units.h"

namespace culet {

namespace {

using Json = nlohmann::ordered_json;

// Rounds to a billionth of a degree, to hide the rounding of radians.
double tidy_degrees(double radians_value) {
    return std::round(degrees(radians_value) * 1e9) / 1e9;
}

// Per cent; null if no stones were drawn.
Json percents(const std::vector<ViewReturn>& views, std::size_t model, bool table) {
    Json list = Json::array();
    for (const ViewReturn& view : views) {
        const double value = 100 * (table ? view.table : view.whole)[model];
        list.push_back(std::isfinite(value) ? Json(value) : Json());
    }
    return list;
}

Json models_json(const Grade& grade, const GradeSigma* sigma) {
    Json models = Json::array();
    Json tilts = Json::array();
    for (const double tilt : grade.tilts) tilts.push_back(tidy_degrees(tilt));
    const bool table = grade.table >= 0;
    for (std::size_t c = 0; c < grade.curves.size(); ++c) {
        const TiltCurve& curve = grade.curves[c];
        for (int m = 0; m < k_light_model_count; ++m) {
            const auto i = static_cast<std::size_t>(m);
            Json model{{"name", name_of(static_cast<LightModel>(m))},
                       {"tilt_deg", tilts},
                       {"tilt_azimuth_deg", tidy_degrees(curve.axis)},
                       {"whole", percents(curve.returns, i, false)},
                       {"table", table ? percents(curve.returns, i, true) : Json::array()}};
            if (sigma != nullptr && c < sigma->curves.size()) {
                model["sigma_whole"] = percents(sigma->curves[c].returns, i, false);
                if (table) model["sigma_table"] = percents(sigma->curves[c].returns, i, true);
            }
            models.push_back(std::move(model));
        }
    }
    return models;
}

Json face_up_json(const Grade& grade) {
    Json json = Json::object();
    for (int m = 0; m < k_light_model_count; ++m) {
        const auto i = static_cast<std::size_t>(m);
        json[name_of(static_cast<LightModel>(m))] = {
            {"whole", 100 * grade.face_up.whole[i]},
            {"table", grade.table >= 0 ? Json(100 * grade.face_up.table[i]) : Json()}};
    }
    return json;
}

Json shares_json(const AsetShares& shares) {
    return {
        {"red", shares.red}, {"green", shares.green}, {"blue", shares.blue}, {"dark", shares.dark}};
}

Json fire_json(const std::optional<Fire>& fire) {
    if (!fire) return nullptr;
    return {{"separated", fire->separated},
            {"matched", fire->matched},
            {"spread_deg", degrees(fire->spread)},
            {"spectral", fire->spectral},
            {"apart_deg", k_fire_apart_deg},
            {"pupil_deg", k_pupil_deg},
            {"wavelengths", k_fire_nm}};
}

Json hearts_json(const Hearts& hearts) {
    Json list = Json::array();
    for (const Heart& heart : hearts.list)
        list.push_back({{"azimuth_deg", degrees(heart.azimuth)},
                        {"area", heart.area},
                        {"width_deg", degrees(heart.width)},
                        {"cleft", heart.cleft}});
    return {{"count", hearts.count}, {"evenness", hearts.evenness},
            {"cleft", hearts.cleft}, {"cleft_evenness", hearts.cleft_evenness},
            {"area", hearts.area},   {"list", list}};
}

Json arrows_json(const Arrows& arrows) {
    Json list = Json::array();
    for (const Arrow& arrow : arrows.list)
        list.push_back({{"azimuth_deg", degrees(arrow.azimuth)},
                        {"head", arrow.head},
                        {"shaft", arrow.shaft},
                        {"axis", arrow.axis}});
    return {{"count", arrows.count},
            {"heads", arrows.list.size()},
            {"evenness", arrows.evenness},
            {"area", arrows.area},
            {"list", list}};
}

Json sigma_json(const GradeSigma* sigma) {
    if (sigma == nullptr) return Json::object();
    Json json = Json::object();
    for (const auto& [name, value] : sigma->figures) json[name] = value;
    return json;
}

}  // namespace

GradeContext grade_context(const Solid& solid, const Material* material,
                           const GradeOptions& options) {
    GradeContext context;
    if (material != nullptr) {
        context.material = material->id;
        context.crystal = material->optic != OpticCharacter::isotropic;
    }
    for (const Facet& facet : solid.facets) context.facets.push_back(facet.name);
    context.options = options;
    return context;
}

std::string grade_json(const Grade& grade, const GradeContext& context) {
    Json json;
    json["schema"] = 1;
    json["name"] = context.name;
    json["file"] = context.file;
    json["material"] = context.material.empty() ? Json() : Json(context.material);
    json["index"] = grade.index.n;
    json["crystal"] = context.crystal ? "merged" : "none";
    json["silhouette_area"] = grade.silhouette_area;
    json["head_deg"] = tidy_degrees(context.options.head);
    json["seed"] = context.options.seed;
    json["face_up"] = face_up_json(grade);
    json["models"] = models_json(grade, context.sigma);
    json["aset"] = shares_json(grade.aset);
    json["aset"]["table"] = grade.table >= 0 ? shares_json(grade.aset_table) : Json();
    if (grade.table_reflection.share > 0) {
        json["aset"]["table"]["reflection"] = {
            {"colour", grade.table_reflection.colour},
            {"elevation_deg", degrees(grade.table_reflection.elevation)},
            {"share", grade.table_reflection.share}};
    }
    json["ideal_scope"] = {{"red", grade.ideal_scope.red},
                           {"dark", grade.ideal_scope.dark},
                           {"white", grade.ideal_scope.white}};
    json["dark_field"] = {{"bright", grade.dark_field}};
    json["balance"] = {{"return", grade.balance.useful},
                       {"head", grade.balance.head},
                       {"leak", grade.balance.leak},
                       {"other", grade.balance.other},
                       {"entry_reflection", grade.balance.entry_reflection},
                       {"residual", grade.balance.residual}};
    json["useful_return"] = grade.balance.useful + grade.balance.head;
    json["weighted_light_return"] = grade.weighted_return;
    json["head_shadow"] = grade.head_shadow;
    json["fire"] = fire_json(grade.fire);
    json["hearts"] = hearts_json(grade.hearts);
    json["arrows"] = arrows_json(grade.arrows);
    json["sigma"] = sigma_json(context.sigma);
    if (context.sigma != nullptr) {
        json["sigma_draws"] = context.sigma->draws;
        json["sigma_left_out"] = context.sigma->left_out;
        json["sigma_correlated"] = context.sigma->correlated;
    }
    Json costs = Json::array();
    for (const FacetCost& cost : context.costs)
        costs.push_back({{"facet", context.facets[static_cast<std::size_t>(cost.facet)]},
                         {"cost", cost.cost},
                         {"off_deg", degrees(cost.off)}});
    json["costs"] = costs;
    json["notes"] = context.notes;
    json["changed"] = context.changed;
    return json.dump(1) + "\n";
}

}  // namespace culet
