#include "app/commands/spin_light_json.h"

#include <nlohmann/json.hpp>

#include "stone/numbers/units.h"

namespace culet {

namespace {

using Json = nlohmann::ordered_json;

Json score_json(const Score& score) {
    Json json{{"value", nullptr},
              {"null_mean", score.null_mean},
              {"null_sd", score.null_sd},
              {"sigmas", nullptr}};
    if (score.value) json["value"] = *score.value;
    if (score.z) json["sigmas"] = *score.z;
    return json;
}

}  // namespace

void add_light(const std::vector<SpinFrame>& frames, const std::string& material,
               const SeriesLight& light, nlohmann::ordered_json& json) {
    Json zones = Json::array();
    for (const ZoneLight& zone : light.zones)
        zones.push_back(
            {{"zone", zone.name},
             {"elevation_deg", {degrees(zone.elevation[0]), degrees(zone.elevation[1])}},
             {"azimuth_deg", {degrees(zone.azimuth[0]), degrees(zone.azimuth[1])}},
             {"radiance", zone.radiance},
             {"share", zone.share}});
    json["light"] = {{"material", material}, {"frames", light.frames}, {"zones", zones}};
    if (light.left_out.empty()) return;
    Json left_out = Json::array();
    for (const FrameLikeness& frame : light.left_out)
        left_out.push_back({{"file", frames[frame.frame].name},
                            {"zncc", score_json(frame.zncc)},
                            {"zncc_4pct", score_json(frame.coarse)}});
    json["comparison"] = {{"verdict", light.verdict},
                          {"zncc", score_json(light.mean)},
                          {"zncc_4pct", score_json(light.coarse_mean)},
                          {"frames", left_out}};
}

}  // namespace culet
