// A study of a scene as JSON and as comma-separated values.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "compare/study/scene_study.h"
#include "page/json_fields.h"
#include "render/planner/explain.h"

namespace culet {

namespace {

using OrderedJson = nlohmann::ordered_json;
constexpr auto study_number = json_number<OrderedJson>;

OrderedJson errors(const PictureError& error) {
    return {{"error", study_number(error.mean)},
            {"rmse", study_number(error.rmse)},
            {"psnr", study_number(error.psnr)},
            {"deltaE00_mean", study_number(error.delta_e_mean)},
            {"deltaE00_p95", study_number(error.delta_e_95)},
            {"flip_mean", study_number(error.flip)}};
}

OrderedJson effects_of(const RenderStats& stats) {
    OrderedJson effects = OrderedJson::array();
    for (const EffectDecision& decision : stats.effects) {
        effects.push_back({{"name", name_of(decision.effect)},
                           {"on", decision.on},
                           {"why", decision.why},
                           {"error_bound", study_number(decision.error_bound)}});
    }
    return effects;
}

std::string effects_asked(const RenderSettings& settings) {
    if (settings.effects_auto) return "auto";
    std::string names;
    for (int e = 0; e < k_effect_count; ++e) {
        if (!settings.effects[static_cast<std::size_t>(e)]) continue;
        names += (names.empty() ? "" : " ") + std::string(name_of(static_cast<Effects>(e)));
    }
    return names.empty() ? "none" : names;
}

std::string names_of_effects(const RenderStats& stats) {
    std::string names;
    for (const EffectDecision& decision : stats.effects) {
        if (decision.on)
            names += (names.empty() ? "" : " ") + std::string(name_of(decision.effect));
    }
    return names;
}

// The fields of a table row.
OrderedJson row_of(const StudiedRender& render) {
    const RenderSettings& asked = render.settled;
    OrderedJson row = {
        {"id", render.id},
        {"sweep", render.sweep},
        {"setting", render.setting},
        {"words", render.words},
        {"automatic", render.automatic},
        {"engine", render.stats.engine},
        {"tolerance", render.automatic ? render.settings.tolerance : asked.tolerance},
        {"depth_asked", asked.depth},
        {"depth", render.stats.depth},
        {"samples", asked.samples},
        {"wavelengths", render.stats.wavelengths_nm.size()},
        {"cut_weight", asked.cut_weight ? OrderedJson(*asked.cut_weight) : OrderedJson(nullptr)},
        {"effects_asked", effects_asked(render.settings)},
        {"names_of_effects", names_of_effects(render.stats)},
        {"crystal_beams", !asked.crystal_beams                           ? "auto"
                          : *asked.crystal_beams == CrystalBeams::merged ? "merged"
                                                                         : "split"}};
    row.update(errors(render.error));
    row.update(
        OrderedJson{{"claimed_error", study_number(render.claimed_error)},
                    {"at_noise", render.at_noise},
                    {"runs", render.runs},
                    {"cpu_seconds", render.cpu.median},
                    {"cpu_least", render.cpu.least},
                    {"cpu_most", render.cpu.most},
                    {"checked_cpu_seconds",
                     render.automatic ? OrderedJson(render.checked_cpu) : OrderedJson(nullptr)},
                    {"wall_seconds", render.wall.median},
                    {"wall_least", render.wall.least},
                    {"wall_most", render.wall.most},
                    {"beams", render.stats.beams},
                    {"rays", render.stats.rays},
                    {"front", render.on_front}});
    return row;
}

OrderedJson id_or_null(const std::optional<int>& id) {
    return id ? OrderedJson(*id) : OrderedJson(nullptr);
}

}  // namespace

std::string scene_study_json(const SceneStudy& study) {
    OrderedJson object;
    object["schema"] = 1;
    object["kind"] = "scene";
    object["name"] = study.name;
    object["usable"] = study.usable();
    object["size"] = {study.width, study.height};
    object["scene_size"] = {study.scene_width, study.scene_height};
    object["threads"] = study.asked.threads;
    const StudyReference& reference = study.reference;
    object["reference"] = {{"samples", reference.samples},
                           {"rough_samples", reference.control_samples},
                           {"tolerance", reference.tolerance},
                           {"depth", reference.stats.depth},
                           {"wavelengths", reference.stats.wavelengths_nm.size()},
                           {"error_bound", study_number(reference.stats.error_bound)},
                           {"noise", errors(reference.noise)},
                           {"cpu_seconds", reference.cpu_seconds},
                           {"ended", reference.ended},
                           {"stone_pixels", reference.stone_pixels},
                           {"mean_radiance", study_number(reference.mean_radiance)},
                           {"white", study_number(reference.white)},
                           {"effects", effects_of(reference.stats)}};
    OrderedJson rows = OrderedJson::array();
    for (const StudiedRender& render : study.renders) {
        OrderedJson row = row_of(render);
        row["effects"] = effects_of(render.stats);
        row["error_bound"] =
            render.automatic ? study_number(render.stats.error_bound) : OrderedJson(nullptr);
        if (render.stats.plan) row["plan"] = OrderedJson::parse(plan_json(*render.stats.plan));
        rows.push_back(std::move(row));
    }
    object["settings"] = std::move(rows);
    object["front"] = study.front;
    OrderedJson advice = OrderedJson::array();
    for (const StudyAdvice& one : study.advice) {
        advice.push_back({{"tolerance", one.tolerance},
                          {"cheapest", id_or_null(one.cheapest)},
                          {"automatic", id_or_null(one.automatic)},
                          {"automatic_meets", one.automatic_meets},
                          {"automatic_over_cheapest", study_number(one.ratio)},
                          {"words", one.words}});
    }
    object["recommendations"] = std::move(advice);
    object["left_out"] = study.left_out;
    object["notes"] = study.notes;
    object["cpu_seconds"] = study.cpu_seconds;
    object["options"] = {{"size", study.options.size},
                         {"budget", study.options.budget_seconds},
                         {"tolerances", study.options.tolerances},
                         {"runs", study.options.runs},
                         {"seed", study.asked.seed}};
    // A name need not be UTF-8.
    return object.dump(1, ' ', false, OrderedJson::error_handler_t::replace) + "\n";
}

std::string scene_study_csv(const SceneStudy& study) {
    std::string text;
    for (const StudiedRender& render : study.renders) {
        const OrderedJson row = row_of(render);
        std::string head, line;
        for (const auto& [key, value] : row.items()) {
            head += (head.empty() ? "" : ",") + key;
            if (!line.empty()) line += ",";
            if (value.is_null()) continue;
            if (!value.is_string()) {
                line += value.dump();
                continue;
            }
            // Settings in words contain commas, but never quotes.
            const std::string cell = value.get<std::string>();
            line += cell.find(',') == std::string::npos ? cell : '"' + cell + '"';
        }
        if (text.empty()) text = head + "\n";
        text += line + "\n";
    }
    return text;
}

}  // namespace culet
