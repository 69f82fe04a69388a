#include "compare/report/scores_json.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "compare/calibration/calibrated_verdict_json.h"
#include "page/json_fields.h"

namespace culet {

namespace {

using OrderedJson = nlohmann::ordered_json;
constexpr auto score_number = json_number<OrderedJson>;

OrderedJson registration_json(const Registration& r) {
    OrderedJson json;
    json["residual_px"] = score_number(r.residual_px);
    json["worst_px"] = score_number(r.worst_px);
    json["iou"] = score_number(r.iou);
    json["scale"] = score_number(r.scale);
    json["turn_deg"] = score_number(r.turn_deg);
    json["turn_known"] = r.turn_known;
    json["shift_px"] = {score_number(r.shift_px[0]), score_number(r.shift_px[1])};
    json["centre_px"] = {score_number(r.centre_px[0]), score_number(r.centre_px[1])};
    json["photo_diameter_px"] = score_number(r.photo_diameter_px);
    json["render_diameter_px"] = score_number(r.render_diameter_px);
    json["photo_outline"] = r.photo_outline;
    json["render_outline"] = r.render_outline;
    json["warnings"] = r.warnings;
    return json;
}

OrderedJson reflexes_json(const ReflexCount& reflexes) {
    return {
        {"photo", reflexes.in_photo},       {"render", reflexes.in_render},
        {"matched", reflexes.matched},      {"displacement", score_number(reflexes.displacement)},
        {"coloured", reflexes.coloured},    {"same_hue", reflexes.same_hue},
        {"sentence", sentence_of(reflexes)}};
}

OrderedJson null_json(const Comparison& comparison) {
    OrderedJson json;
    json["kind"] = "turned_render";
    json["draws"] = comparison.null_draws;
    json["seed"] = comparison.seed;
    json["note"] = comparison.null_note;
    for (const Score& score : comparison.scores) {
        OrderedJson& one = json[score.key];
        const bool any = !score.null.empty();
        one["mean"] = any ? score_number(score.null_mean) : OrderedJson(nullptr);
        one["sd"] = any ? score_number(score.null_sd) : OrderedJson(nullptr);
        one["z"] = score_number(score.z);
        one["p"] = score_number(score.p);
        one["higher_is_better"] = score.higher_is_better;
        one["values"] = OrderedJson::array();
        for (const double value : score.null) one["values"].push_back(score_number(value));
    }
    return json;
}

}  // namespace

std::string scores_json(const Comparison& comparison, const CompareSources& sources,
                        const std::optional<CalibratedVerdict>& calibrated) {
    OrderedJson json;
    json["schema"] = 1;
    json["command"] = "compare";
    json["verdict"] = name_of(comparison.verdict);
    json["reason"] = comparison.reason;
    json["equivalent_facet_error_deg"] =
        calibrated ? score_number(calibrated->equivalent.deg) : OrderedJson(nullptr);
    json["geometry_only"] = comparison.geometry_only;
    json["simulated"] = comparison.simulated;
    json["photo"] = sources.photo_file;
    json["render"] = sources.render_file;
    json["mask"] =
        sources.mask_file.empty() ? OrderedJson(nullptr) : OrderedJson(sources.mask_file);
    json["seed"] = comparison.seed;
    json["registration"] = registration_json(comparison.registration);
    if (!sources.pose.empty()) json["pose"] = OrderedJson::parse(sources.pose, nullptr, false);
    json["gain"] = {score_number(comparison.gain[0]), score_number(comparison.gain[1]),
                    score_number(comparison.gain[2])};
    json["saturated"] = score_number(comparison.saturated);
    json["compared_pixels"] = comparison.compared_pixels;
    json["render_blur_px"] = score_number(comparison.render_blur_px);
    json["scores"] = OrderedJson::object();
    json["score_notes"] = OrderedJson::object();
    for (const Score& score : comparison.scores) {
        json["scores"][score.key] = score_number(score.value);
        if (!score.note.empty()) json["score_notes"][score.key] = score.note;
    }
    json["reflexes"] = reflexes_json(comparison.reflexes);
    json["light_return"] = {{"photo", score_number(comparison.photo_light)},
                            {"render", score_number(comparison.render_light)}};
    if (comparison.within)
        json["within_readings"] = {{"one_sigma", score_number(comparison.within->within_one)},
                                   {"two_sigma", score_number(comparison.within->within_two)},
                                   {"pixels", comparison.within->pixels}};
    json["null"] = null_json(comparison);
    json["sensitivity"] = calibrated ? sensitivity_json(*calibrated) : OrderedJson::array();
    if (calibrated) json["meaning"] = calibrated_verdict_json(*calibrated);
    json["verdict_rule"] =
        calibrated
            ? std::string(k_calibrated_rule)
            : fmt::format(
                  "match: zncc at least {} standard deviations above its null (of atanh) and at "
                  "least {}; partial: at least {} standard deviations and better than every draw; "
                  "else "
                  "no_evidence. A "
                  "proposal, not validated.",
                  k_match_z, k_match_zncc, k_partial_z);
    json["notes"] = comparison.notes;
    if (!comparison.pose_note.empty()) json["notes"].push_back("pose: " + comparison.pose_note);
    // File names need not be UTF-8: invalid bytes are replaced, so that nothing throws.
    return json.dump(2, ' ', false, OrderedJson::error_handler_t::replace) + "\n";
}

}  // namespace culet
