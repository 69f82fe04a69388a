// Report section on the registration of render and photograph.

#include <fmt/format.h>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "compare/photo/pixels.h"
#include "compare/report/report_parts.h"
#include "compare/templates.h"
#include "page/html.h"
#include "page/parts.h"

namespace culet {

namespace {

/// Outline of a mask as an SVG path, to half a pixel.
std::string outline_path(const PixelMap& map) {
    if (map.values.empty()) return {};
    const cv::Mat inside =
        cv::Mat(map.height, map.width, CV_32F, const_cast<float*>(map.values.data())) > 0.5;
    std::vector<std::vector<cv::Point>> outlines;
    cv::findContours(inside, outlines, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
    std::string path;
    for (const auto& outline : outlines) {
        std::vector<cv::Point> points;
        cv::approxPolyDP(outline, points, 0.5, true);
        for (std::size_t i = 0; i < points.size(); ++i) {
            path += fmt::format("{}{:.1f},{:.1f}", i == 0 ? "M" : "L", points[i].x + 0.5,
                                points[i].y + 0.5);
        }
        path += "Z";
    }
    return path;
}

}  // namespace

std::string registration_section(const Report& report) {
    if (!report.comparison) return {};
    const Comparison& c = *report.comparison;
    const Photo& photo = c.pictures.photo;
    if (photo.rgb.empty()) return {};
    const std::string word = photo_word(report);
    const Registration& r = c.registration;
    const std::string pose = report.pose_overlay_png;
    const std::string body =
        filled(templates::report_registration,
               {{"width", std::to_string(photo.width)},
                {"height", std::to_string(photo.height)},
                {"word", word},
                {"uri", picture_uri(photo, white_shown(c))},
                {"photo_path", outline_path(c.pictures.photo_outline)},
                {"render_path", outline_path(c.pictures.render_outline)},
                {"overlap", decimals(r.iou, 4)},
                {"apart", decimals(r.residual_px, 2)},
                {"apart_at_most", decimals(r.worst_px, 2)},
                {"shift_x", decimals(r.shift_px[0], 2)},
                {"shift_y", decimals(r.shift_px[1], 2)},
                {"turn", r.turn_known ? decimals(r.turn_deg, 3) + "°" : "not seen in the outline"},
                {"scale", decimals(r.scale, 5)},
                {"photo_px", decimals(r.photo_diameter_px, 0)},
                {"render_px", decimals(r.render_diameter_px, 0)},
                {"photo_outline", r.photo_outline},
                {"render_outline", r.render_outline},
                {"warnings", std::vector<View>(r.warnings.begin(), r.warnings.end())},
                {"pose", !pose.empty()},
                {"pose_uri", pose.empty() ? "" : png_uri(pose)},
                {"used", report.pose_used}});
    // Open after a refusal, because that is about the outlines.
    return folded_section("registration", "How the outlines were laid on one another", body,
                          !c.usable());
}

}  // namespace culet
