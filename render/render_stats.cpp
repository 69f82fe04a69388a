#include <cmath>
#include <nlohmann/json.hpp>

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
    const Json json = {{"schema", 1},
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
                         {"build", 0.0},
                         {"shade", stats.seconds_shade},
                         {"total", stats.seconds_setup + stats.seconds_shade}}},
                       {"worst_imbalance", stats.worst_imbalance},
                       {"notes", stats.notes},
                       {"beams", 0},
                       {"rays", stats.rays}};
    return json.dump(2) + "\n";
}

}  // namespace culet
