// Outputs of a light probe as JSON, TOML and PNG.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "compare/light_probe/light_probe.h"
#include "compare/photo/pixels.h"
#include "page/colour_maps.h"
#include "page/json_fields.h"
#include "stone/numbers/units.h"

namespace culet {

namespace {

using OrderedJson = nlohmann::ordered_json;
constexpr auto number = json_number<OrderedJson>;

constexpr int k_sheet_width = 900;
constexpr int k_caption = 34, k_scale = 44;

cv::Scalar ink() {
    return {40, 40, 40};
}

void write(cv::Mat& sheet, const std::string& text, int x, int y) {
    cv::putText(sheet, text, {x, y}, cv::FONT_HERSHEY_SIMPLEX, 0.5, ink(), 1, cv::LINE_AA);
}

cv::Mat painted(const std::vector<float>& values, int width, int height, double most,
                ColourMap map) {
    cv::Mat picture(height, width, CV_8UC3);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const float v = values[static_cast<std::size_t>(y) * width + x];
            // Grey: no value.
            std::array<std::uint8_t, 3> c{160, 160, 160};
            if (std::isfinite(v)) c = colour_at(map, v / most);
            picture.at<cv::Vec3b>(y, x) = {c[0], c[1], c[2]};
        }
    }
    cv::Mat result;
    cv::resize(picture, result, {k_sheet_width, k_sheet_width / 2}, 0, 0,
               width > k_sheet_width ? cv::INTER_AREA : cv::INTER_NEAREST);
    return result;
}

void draw_panel(cv::Mat& sheet, int top, const std::string& caption, const cv::Mat& panel,
                ColourMap map, const std::string& from, const std::string& to) {
    write(sheet, caption, 8, top + 22);
    panel.copyTo(sheet(cv::Rect(0, top + k_caption, panel.cols, panel.rows)));
    const int y = top + k_caption + panel.rows + 8;
    for (int x = 0; x < 300; ++x) {
        const auto c = colour_at(map, x / 299.0);
        sheet(cv::Rect(300 + x, y, 1, 14)).setTo(cv::Scalar(c[0], c[1], c[2]));
    }
    write(sheet, from, 300 - 12 - static_cast<int>(9 * from.size()), y + 12);
    write(sheet, to, 608, y + 12);
}

OrderedJson list_of(const Vec3& v) {
    return {number(v.x), number(v.y), number(v.z)};
}

OrderedJson json_of(const ProbeViewResult& view) {
    OrderedJson rotation = OrderedJson::array();
    for (int row = 0; row < 3; ++row) {
        rotation.push_back({view.world_from_camera[0][row], view.world_from_camera[1][row],
                            view.world_from_camera[2][row]});
    }
    return {{"name", view.name},
            {"ball",
             {{"x", number(view.circle.x)},
              {"y", number(view.circle.y)},
              {"radius", number(view.circle.radius)},
              {"found", view.found},
              {"support", number(view.support)}}},
            {"distance_radii", number(view.distance)},
            {"distance_from", view.distance_from},
            {"focal_px", number(view.focal_px)},
            {"gain", number(view.gain)},
            {"over_exposed", number(view.over_exposed)},
            {"turned_deg", number(degrees(view.turned))},
            {"centre_radii", list_of(view.centre)},
            {"world_from_camera", rotation}};
}

OrderedJson json_of(const NearLight& light) {
    OrderedJson json{{"status", light.usable() ? "good" : "doubtful"},
                     {"doubt", light.doubt},
                     {"from", light.from},
                     {"radiance", light.radiance},
                     {"over_exposed", number(light.over)},
                     {"distance", number(light.distance)},
                     {"distance_sigma", number(light.distance_sigma)},
                     {"residual_deg", number(degrees(light.residual))}};
    if (!light.usable()) return json;
    json["point"] = list_of(light.window.middle);
    json["normal"] = list_of(light.normal);
    json["u"] = list_of(light.window.u);
    json["v"] = list_of(light.window.v);
    json["tilt_deg"] = number(degrees(light.tilt));
    json["tilt_sigma_deg"] = number(degrees(light.tilt_sigma));
    json["tilt_found"] = !light.facing;
    return json;
}

}  // namespace

std::string light_json(const LightProbe& probe, const ProbeOptions& options) {
    OrderedJson json{
        {"schema", 1},
        {"status", probe.usable() ? "good" : "doubtful"},
        {"doubt", probe.doubt},
        {"size", {probe.light.map.width, probe.light.map.height}},
        {"covered", number(probe.covered)},
        {"filled_sr", number(probe.light.filled_sr)},
        {"disagreement",
         {{"mean_stops", number(probe.mean_disagreement)},
          {"median_stops", number(probe.middle_disagreement)},
          {"worst_percent_stops", number(probe.worst_disagreement)}}},
        {"reflectance", options.reflectance},
        {"towards_deg", {degrees(options.towards_azimuth), degrees(options.towards_elevation)}}};
    json["views"] = OrderedJson::array();
    for (const ProbeViewResult& view : probe.views) json["views"].push_back(json_of(view));
    json["alignments"] = OrderedJson::array();
    for (const ViewAlignment& a : probe.alignments) {
        json["alignments"].push_back({{"correlation", number(a.correlation)},
                                      {"next_best_correlation", number(a.rival)},
                                      {"median_disagreement_stops", number(a.residual)},
                                      {"gain", number(a.gain)},
                                      {"sigma_deg", number(degrees(a.sigma))},
                                      {"ambiguous", a.ambiguous}});
    }
    if (!probe.near_lights.empty()) {
        json["ball_radius"] = number(options.ball_radius);
        json["near_lights"] = OrderedJson::array();
        for (const NearLight& light : probe.near_lights)
            json["near_lights"].push_back(json_of(light));
    }
    json["notes"] = probe.notes;
    return json.dump(2, ' ', false, OrderedJson::error_handler_t::replace) + "\n";
}

std::string light_toml(const LightProbe& probe, const std::string& environment) {
    const auto vector = [](const Vec3& v) {
        return fmt::format("[{:.9g}, {:.9g}, {:.9g}]", v.x, v.y, v.z);
    };
    // JSON's escapes of a path are valid in TOML.
    std::string toml = fmt::format(
        "[light]\nenvironment = {}\n",
        OrderedJson(environment).dump(-1, ' ', false, OrderedJson::error_handler_t::replace));
    for (const NearLight& light : probe.near_lights) {
        if (!light.usable()) continue;
        const std::string how =
            light.from == "measured"
                ? std::string("as measured")
                : fmt::format("{:.4g} away{}, edges within {:.2f} degrees", light.distance,
                              light.from == "parallax"
                                  ? fmt::format(" (sigma {:.2g})", light.distance_sigma)
                                  : std::string(" as given"),
                              degrees(light.residual));
        toml += fmt::format(
            "\n[[light.plane]]  # {}\npoint = {}\nnormal = {}\nu = {}\nv = {}\nradiance = {}\n",
            how, vector(light.window.middle), vector(light.normal), vector(light.window.u),
            vector(light.window.v),
            vector({light.radiance[0], light.radiance[1], light.radiance[2]}));
    }
    return toml;
}

std::string coverage_png(const LightProbe& probe) {
    const MergedLight& light = probe.light;
    const int panel = k_caption + k_sheet_width / 2 + k_scale;
    cv::Mat sheet(2 * panel, k_sheet_width, CV_8UC3, cv::Scalar(255, 255, 255));
    draw_panel(sheet, 0,
               fmt::format("Coverage: {:.1f} % of all directions are seen", 100 * probe.covered),
               painted(light.coverage, light.map.width, light.map.height, 1, ColourMap::error),
               ColourMap::error, "unseen", "in the middle of a ball");
    const std::string caption = probe.views.size() > 1 && !probe.moved
                                    ? fmt::format(
                                          "Two views differ by less than {:.2f} stops over half of "
                                          "the room, {:.2f} over 99 %",
                                          probe.middle_disagreement, probe.worst_disagreement)
                                    : std::string("Disagreement: needs a second view");
    draw_panel(sheet, panel, caption,
               painted(light.disagreement, light.map.width, light.map.height, 2, ColourMap::error),
               ColourMap::error, "0 stops", "2 and more; grey: one view");
    return png_bytes(sheet);
}

}  // namespace culet
