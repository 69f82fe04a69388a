#include <cmath>
#include <nlohmann/json.hpp>

#include "render/planner/explain.h"
#include "render/render.h"

namespace culet {

std::string stats_json(const RenderStats& stats) {
    using Json = nlohmann::ordered_json;
    Json effects = Json::array();
    for (const EffectDecision& decision : stats.effects) {
        Json bound = decision.error_bound;
        if (std::isnan(decision.error_bound)) bound = nullptr;
        effects.push_back({{"name", name_of(decision.effect)},
                           {"on", decision.on},
                           {"why", decision.why},
                           {"error_bound", bound}});
    }
    Json json = {{"schema", 1},
                 {"engine", stats.engine},
                 {"depth", stats.depth},
                 {"effects", effects},
                 {"wavelengths", stats.wavelengths_nm},
                 {"error_bound", stats.error_bound},
                 {"remainder", stats.remainder},
                 {"cut", stats.cut},
                 {"absorbed", stats.absorbed},
                 {"standard_error", stats.standard_error},
                 {"mean_radiance", stats.mean_radiance},
                 {"seconds",
                  {{"setup", stats.seconds_setup},
                   {"build", stats.seconds_build},
                   {"shade", stats.seconds_shade},
                   {"check", stats.seconds_check},
                   {"total", stats.seconds_setup + stats.seconds_build + stats.seconds_shade +
                                 stats.seconds_check}}},
                 {"sampling_error", stats.sampling_error},
                 {"worst_imbalance", stats.worst_imbalance},
                 {"notes", stats.notes},
                 {"engine_error", stats.engine_error},
                 {"checked_pixels", stats.checked_pixels},
                 {"beams", stats.beams},
                 {"retraced", stats.retraced},
                 {"lost_area", stats.lost_area},
                 {"rays", stats.rays}};
    if (stats.allowed_tolerance) json["allowed_tolerance"] = *stats.allowed_tolerance;
    if (stats.plan) json["plan"] = Json::parse(plan_json(*stats.plan));
    if (stats.verification) {
        const Verification& v = *stats.verification;
        json["verification"] = {{"pixels", v.pixels},
                                {"samples", v.samples},
                                {"measured", v.measured},
                                {"difference", v.difference},
                                {"noise", v.noise},
                                {"spread", v.standard_error},
                                {"deltaE00", v.delta_e},
                                {"error_bound", v.bound},
                                {"error_bound_deltaE00", v.bound_delta_e},
                                {"holds", v.holds()},
                                {"seconds", v.seconds}};
    }
    return json.dump(2) + "\n";
}

}  // namespace culet
