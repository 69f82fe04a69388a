#include "compare/calibration/calibrated_verdict_json.h"

#include <nlohmann/json.hpp>

#include "page/json_fields.h"

namespace culet {

namespace {

using OrderedJson = nlohmann::ordered_json;
constexpr auto number_or_null = json_number<OrderedJson>;

}  // namespace

OrderedJson equivalent_json(const EquivalentError& error) {
    return {{"deg", number_or_null(error.deg)},
            {"low_deg", error.deg ? number_or_null(error.low_deg) : OrderedJson(nullptr)},
            {"high_deg", error.deg ? number_or_null(error.high_deg) : OrderedJson(nullptr)},
            {"at_least", error.at_least},
            {"at_most", error.at_most}};
}

OrderedJson calibrated_verdict_json(const CalibratedVerdict& verdict) {
    const Calibration& calibration = verdict.calibration;
    OrderedJson json;
    json["headline"] = verdict.headline;
    json["geometry_only"] = verdict.geometry_only;
    json["equivalent_facet_error"] = equivalent_json(verdict.equivalent);
    json["evidence"] = number_or_null(verdict.evidence);
    json["nulls"] = OrderedJson::array();
    for (const NullStatistics& null : verdict.nulls) {
        json["nulls"].push_back({{"world", name_of(null.alternative)},
                                 {"draws", null.draws},
                                 {"zncc_mean", number_or_null(null.mean)},
                                 {"zncc_sd", number_or_null(null.sd)},
                                 {"z", number_or_null(null.z)},
                                 {"as_good", null.as_good},
                                 {"p", number_or_null(null.p)},
                                 {"least_deg", number_or_null(null.least_deg)},
                                 {"median_deg", number_or_null(null.median_deg)}});
    }
    json["hypotheses"] = OrderedJson::array();
    for (const HypothesisScore& h : verdict.hypotheses) {
        json["hypotheses"].push_back({{"world", name_of(h.alternative)},
                                      {"name", h.name},
                                      {"zncc", number_or_null(h.zncc)},
                                      {"equivalent_facet_error", equivalent_json(h.equivalent)}});
    }
    json["calibration"] = {{"hash", calibration.hash},
                           {"draws", calibration.draws.size()},
                           {"seed", calibration.seed},
                           {"stone_px", number_or_null(calibration.stone_px)},
                           {"psf_px", number_or_null(calibration.psf_px)},
                           {"electrons", number_or_null(calibration.electrons)},
                           {"from_cache", calibration.from_cache},
                           {"notes", calibration.notes}};
    return json;
}

OrderedJson sensitivity_json(const CalibratedVerdict& verdict) {
    OrderedJson rows = OrderedJson::array();
    if (verdict.curves.empty()) return rows;
    for (std::size_t level = 0; level < verdict.curves.front().levels.size(); ++level) {
        OrderedJson row;
        row["facet_error_deg"] =
            number_or_null(verdict.curves.front().levels[level].facet_error_deg);
        for (const SensitivityCurve& curve : verdict.curves) {
            const SensitivityCurve::Level& at = curve.levels[level];
            row[curve.key] = {{"draws", at.draws},
                              {"mean", number_or_null(at.mean)},
                              {"sd", number_or_null(at.sd)},
                              {"fitted", number_or_null(at.fitted)}};
        }
        rows.push_back(std::move(row));
    }
    return rows;
}

}  // namespace culet
