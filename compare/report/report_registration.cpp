// How the render was laid on the photograph, as the report shows it.

#include <fmt/format.h>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "compare/photo/pixels.h"
#include "compare/report/report_parts.h"
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
    std::string body = "<div class=\"beside\">\n<figure class=\"overlay\">";
    body += fmt::format(
        "<svg viewBox=\"0 0 {0} {1}\" role=\"img\" aria-label=\"Outlines of the stone in both "
        "pictures over the {2}\"><image href=\"{3}\" width=\"{0}\" height=\"{1}\" "
        "opacity=\"0.55\"/>"
        "<path class=\"outline-photo\" d=\"{4}\"/><path class=\"outline-render\" d=\"{5}\"/></svg>",
        photo.width, photo.height, word, picture_uri(photo, white_shown(c)),
        outline_path(c.pictures.photo_outline), outline_path(c.pictures.render_outline));
    body += fmt::format(
        "<figcaption><span class=\"key-photo\">outline in the {}</span> "
        "<span class=\"key-render\">outline in the render</span></figcaption>"
        "</figure>\n",
        word);
    const Registration& r = c.registration;
    std::string rows;
    const auto row = [&](const std::string& name, const std::string& value) {
        rows +=
            fmt::format("<tr><th scope=\"row\">{}</th><td class=\"n\">{}</td></tr>\n", name, value);
    };
    row("Overlap (area of both over area of either)", decimals(r.iou, 4));
    row("Outlines apart, root mean square", decimals(r.residual_px, 2) + " px");
    row("95 % of the outline closer than", decimals(r.worst_px, 2) + " px");
    row("Shift", decimals(r.shift_px[0], 2) + ", " + decimals(r.shift_px[1], 2) + " px");
    row("Turn, clockwise",
        r.turn_known ? decimals(r.turn_deg, 3) + "°" : "not seen in the outline");
    row("Scale, render over " + word, decimals(r.scale, 5));
    row("Stone in the " + word, decimals(r.photo_diameter_px, 0) + " px across");
    row("Stone in the render", decimals(r.render_diameter_px, 0) + " px across");
    row("Outlines taken from", escaped(r.photo_outline + ", " + r.render_outline));
    body += "<div>" + table("Registration by the outlines",
                            "<th scope=\"col\">Quantity</th>"
                            "<th scope=\"col\" class=\"n\">Value</th>",
                            rows);
    for (const std::string& warning : r.warnings) {
        body += fmt::format("<p class=\"warning\">{}</p>\n", escaped(warning));
    }
    body += "</div>\n</div>\n";
    if (!report.pose_overlay_png.empty()) {
        body += fmt::format(
            "<figure class=\"pose\"><img src=\"{}\" alt=\"The stone's edges over the {}\">"
            "<figcaption>{}</figcaption></figure>\n",
            png_uri(report.pose_overlay_png), word,
            report.pose_used ? "The stone's edges where the pose puts them."
                             : "The best pose that was found. It was not trusted, and the scene's "
                               "own camera was taken.");
    }
    // A refusal is about the outlines.
    return folded_section("registration", "How the outlines were laid on one another", body,
                          !c.usable());
}

}  // namespace culet
