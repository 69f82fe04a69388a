#include "app/commands/spin_json.h"

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

Json frame_json(const SpinFrame& frame, const SpinFrameResult& found, double px_mm) {
    Json json{{"file", frame.name}, {"used", found.used}, {"held_out", frame.held_out}};
    if (!found.trouble.empty()) json["trouble"] = found.trouble;
    if (!found.turn) return json;
    json["angle_deg"] = degrees(*found.turn);
    json["sigma_deg"] = degrees(found.turn_sigma);
    json["outline_rms_px"] = found.rms_px;
    json["outline_median_px"] = found.median_px;
    json["line_median_px"] = found.line_median_px;
    Json rows = Json::array();
    for (const auto& row : found.projection)
        rows.push_back({row[0] / px_mm, row[1] / px_mm, row[2] / px_mm, row[3]});
    json["projection"] = std::move(rows);
    return json;
}

}  // namespace

nlohmann::ordered_json spin_json(const std::vector<SpinFrame>& frames, const SpinResult& found,
                                 double width_mm) {
    const double px_mm = width_mm > 0 ? width_mm / found.width().value : 1;
    Json json{{"schema", 1}, {"unit", width_mm > 0 ? "mm" : "px"}, {"frames", Json::array()}};
    for (std::size_t f = 0; f < frames.size(); ++f)
        json["frames"].push_back(frame_json(frames[f], found.frames[f], px_mm));
    json["camera"] = {{"elevation_deg", degrees(found.camera.elevation)},
                      {"roll_deg", degrees(found.camera.roll)},
                      {"axis_px", found.camera.axis},
                      {"perspective", found.camera.perspective * found.width().value}};
    for (const SpinProportion& p : found.proportions) {
        const double scale = p.name == "width" ? px_mm : 1;
        json["proportions"][p.name] = {
            {"value", p.value * scale}, {"sigma", p.sigma * scale}, {"read", p.read}};
    }
    if (found.edges > 0)
        json["crown"] = {{"edges", found.edges}, {"edge_sigma_px", found.edge_sigma_px}};
    const Halves& halves = found.halves;
    json["halves"] = {{"facets", halves.facets.count},
                      {"facet_deg", degrees(halves.facets.tilt)},
                      {"large_facets", halves.large_facets.count},
                      {"large_facet_deg", degrees(halves.large_facets.tilt)},
                      {"sigmas_times", halves.factor},
                      {"up_deg", degrees(halves.up)},
                      {"elevation_deg", degrees(halves.elevation)}};
    for (const auto& [name, difference] : halves.proportions)
        json["halves"]["proportions"][name] = difference * (name == "width" ? px_mm : 1);
    json["ground_agreement"] = found.ground_agreement;
    json["tangent_rms_px"] = found.tangent_px;
    json["scatter_px"] = found.scatter_px;
    json["notes"] = found.notes;
    if (!found.trouble.empty()) json["trouble"] = found.trouble;
    json["unseen"] = Json::array();
    for (const int f : found.unseen)
        json["unseen"].push_back(found.solid.facets[std::size_t(f)].name);
    if (const auto& symmetry = found.symmetry)
        json["symmetry"] = {{"order", found.tried.order},
                            {"mirrors", found.tried.mirrors},
                            {"pairs", symmetry->pairs},
                            {"sigma_deg", degrees(symmetry->tilt_sigma)},
                            {"offset_sigma", symmetry->offset_sigma * px_mm}};
    json["by_symmetry"] = Json::array();
    for (const int f : found.copies)
        json["by_symmetry"].push_back(found.solid.facets[std::size_t(f)].name);
    json["facets"] = Json::array();
    for (std::size_t f = 0; f < found.solid.facets.size(); ++f) {
        const Facet& facet = found.solid.facets[f];
        const Vec3& n = facet.plane.normal;
        json["facets"].push_back({{"name", facet.name},
                                  {"normal", {n.x, n.y, n.z}},
                                  {"offset", facet.plane.offset * px_mm},
                                  {"area", area(found.solid, facet) * px_mm * px_mm},
                                  {"sigma_deg", degrees(found.tilt_sigmas[f])}});
    }
    return json;
}

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
