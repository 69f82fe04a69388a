#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "compare/pose/find_pose.h"
#include "stone/numbers/units.h"

namespace culet {

namespace {

using OrderedJson = nlohmann::ordered_json;

OrderedJson vector_of(const Vec3& v) {
    return {v.x, v.y, v.z};
}

OrderedJson camera_json(const Camera& camera) {
    OrderedJson json{{"position", vector_of(camera.position)},
                     {"look_at", vector_of(camera.look_at)},
                     {"up", vector_of(camera.up)}};
    if (camera.orthographic_width) {
        json["orthographic_width"] = *camera.orthographic_width;
    } else {
        json["fov"] = degrees(camera.fov);
    }
    json["size"] = {camera.width, camera.height};
    if (camera.principal_point) json["principal_point"] = *camera.principal_point;
    return json;
}

}  // namespace

std::string pose_json(const FoundPose& pose) {
    OrderedJson json{{"schema", 1}};
    json["status"] = pose.usable() ? "found" : "refused";
    json["trouble"] = pose.trouble;
    json["remedy"] = pose.remedy;
    json["doubt"] = pose.error_probability;
    json["camera"] = camera_json(pose.camera);
    json["mirrored"] = pose.mirrored;
    json["chirality_known"] = pose.chirality_known;
    const PoseSigmas& s = pose.sigmas;
    json["sigma"] = {{"turn_x_deg", degrees(s.turn[0])},
                     {"turn_y_deg", degrees(s.turn[1])},
                     {"turn_sight_deg", degrees(s.turn[2])},
                     {"angle_deg", degrees(s.angle)},
                     {"angle_99_deg", degrees(s.angle_99)},
                     {"shift_px", s.shift_px},
                     {"shift_99_px", s.shift_99_px},
                     {"scale", s.scale},
                     {"focal_length", s.focal},
                     {"principal_point_px", s.principal_point}};
    json["start"] = {{"angle_deg", degrees(pose.start_angle)}, {"scale", pose.start_scale}};
    json["outline"] = {{"source", pose.outline_source},
                       {"diameter_px", pose.diameter_px},
                       {"distance_px", pose.outline_px}};
    json["crown"] = {{"distance_px", pose.crown_px},
                     {"met", pose.crown_support},
                     {"met_by_chance", pose.chance_support},
                     {"z", pose.support_z},
                     {"edges", pose.evidence.looked},
                     {"edges_met", pose.evidence.met},
                     {"edges_met_by_chance", pose.evidence.chance_share * pose.evidence.looked},
                     {"log_odds", pose.evidence.log_odds}};
    json["facet_error_deg"] = degrees(pose.facet_error);
    json["facet_offset"] = pose.facet_offset;
    json["others"] = OrderedJson::array();
    for (const TriedPose& other : pose.others) {
        json["others"].push_back({{"camera", camera_json(other.camera)},
                                  {"mirrored", other.mirrored},
                                  {"turn_deg", degrees(other.turn)},
                                  {"lead", other.lead},
                                  {"symmetric", other.symmetric}});
    }
    json["warnings"] = pose.warnings;
    return json.dump(2, ' ', false, OrderedJson::error_handler_t::replace) + "\n";
}

std::vector<std::string> pose_words(const FoundPose& pose) {
    std::vector<std::string> words = pose.warnings;
    if (!pose.usable()) {
        words.push_back("refused: " + pose.trouble + ". " + pose.remedy + ".");
        return words;
    }
    words.push_back(
        fmt::format("found: {:.1f} degrees from the start, {:.3f} times its size; uncertainty "
                    "±{:.2f} degrees, ±{:.2f} px (99 %)",
                    degrees(pose.start_angle), pose.start_scale, degrees(pose.sigmas.angle_99),
                    pose.sigmas.shift_99_px));
    if (pose.sigmas.angle_99 > k_sure_pose)
        words.emplace_back(
            "the view is uncertain: photograph the stone larger and tilted by 10 to 20 degrees, or "
            "fit it to more readings; culet compare refines the view by the picture itself");
    if (pose.mirrored)
        words.emplace_back("the photograph is mirrored: flip it left to right before comparing it");
    if (!pose.chirality_known)
        words.emplace_back(
            "a stone of this symmetry equals its mirror image: taken as not mirrored");
    if (pose.look_alikes > 0)
        words.push_back(
            fmt::format("the stone looks the same from {} other view{}: the one nearest to the "
                        "scene's camera was taken",
                        pose.look_alikes, pose.look_alikes == 1 ? "" : "s"));
    return words;
}

CameraSettings camera_settings(const Camera& camera) {
    const auto vector = [](const Vec3& v) { return fmt::format("[{}, {}, {}]", v.x, v.y, v.z); };
    CameraSettings settings;
    const auto set = [&](const char* key, const std::string& value) {
        settings.overrides.push_back(fmt::format("camera.{}={}", key, value));
    };
    const auto leave = [&](const char* key) {
        settings.without.push_back(fmt::format("camera.{}", key));
    };
    set("position", vector(camera.position));
    set("look_at", vector(camera.look_at));
    set("up", vector(camera.up));
    if (camera.orthographic_width) {
        set("orthographic_width", fmt::format("{}", *camera.orthographic_width));
        leave("fov");
    } else {
        set("fov", fmt::format("{}", degrees(camera.fov)));
        leave("orthographic_width");
    }
    set("size", fmt::format("[{}, {}]", camera.width, camera.height));
    if (camera.principal_point) {
        set("principal_point",
            fmt::format("[{}, {}]", (*camera.principal_point)[0], (*camera.principal_point)[1]));
    } else {
        leave("principal_point");
    }
    return settings;
}

}  // namespace culet
