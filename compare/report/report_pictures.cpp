// The report's pictures: photograph and render overlaid, and maps of their differences.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <optional>
#include <utility>

#include "compare/photo/pixels.h"
#include "compare/report/report_parts.h"
#include "compare/templates.h"
#include "page/html.h"
#include "page/parts.h"
#include "stone/numbers/quantile.h"

namespace culet {

namespace {

View map_figure(const PixelMap& map, ColourMap colours, double low, double high,
                const std::string& title, const std::string& about, const std::string& bar) {
    return {{"uri", map_uri(map, colours, low, high)},
            {"title", title},
            {"about", about},
            {"bar_html", bar}};
}

}  // namespace

std::string map_uri(const PixelMap& map, ColourMap colours, double low, double high) {
    cv::Mat picture(map.height, map.width, CV_8UC4, cv::Scalar(0, 0, 0, 0));
    const float* value_at = map.values.data();
    for (int y = 0; y < map.height; ++y) {
        for (int x = 0; x < map.width; ++x) {
            const double value = static_cast<double>(*value_at++);
            if (std::isnan(value)) continue;
            const auto c = colour_at(colours, (value - low) / (high - low));
            picture.at<cv::Vec4b>(y, x) = {c[2], c[1], c[0], 255};
        }
    }
    return png_uri(png_bytes(picture));
}

std::optional<double> white_for_stone(std::vector<float> brightest) {
    // The median is a medium tone, and 2 to 7 % of the stone (glints) may be over-exposed: without
    // white a picture looks dull.
    constexpr double k_median_shown = 0.4, k_most_over = 0.07, k_least_over = 0.02;
    std::erase_if(brightest, [](float v) { return !(v > 0) || !std::isfinite(v); });
    if (brightest.empty()) return std::nullopt;
    const auto level = [&](double share) { return double(quantile(brightest, share)); };
    return std::clamp(level(0.5) / k_median_shown, level(1 - k_most_over), level(1 - k_least_over));
}

double white_shown(const Comparison& comparison) {
    const ComparedPictures& pictures = comparison.pictures;
    const std::vector<float>& outline = pictures.photo_outline.values;
    std::vector<float> brightest;
    for (std::size_t p = 0; p < outline.size() && 3 * p + 2 < pictures.photo.rgb.size(); ++p) {
        const float* rgb = pictures.photo.rgb.data() + 3 * p;
        if (outline[p] > 0.5f) brightest.push_back(std::max({rgb[0], rgb[1], rgb[2]}));
    }
    return std::min(pictures.white, white_for_stone(std::move(brightest)).value_or(pictures.white));
}

std::string picture_uri(const Photo& picture, double white) {
    cv::Mat shown_now;
    encoded(colour_of(picture) * (1 / std::max(white, 1e-30))).convertTo(shown_now, CV_8U, 255);
    return png_uri(png_bytes(shown_now));
}

std::string pictures_section(const Report& report) {
    if (!report.comparison) return {};
    const ComparedPictures& pictures = report.comparison->pictures;
    if (pictures.photo.rgb.empty() || pictures.render.rgb.empty()) return {};
    const std::string word = photo_word(report);
    const double white = white_shown(*report.comparison);
    const std::string sides = slider(
        "pictures-slider", {word, picture_uri(pictures.photo, white), "The stone in the " + word},
        {"render", picture_uri(pictures.render, white), "The render, laid onto the " + word});
    const std::string brighter =
        white < 0.95 * pictures.white ? significant(pictures.white / white, 2) : "";
    const std::string body =
        filled(templates::report_pictures, {{"slider_html", sides},
                                            {"turn_html", turn_button()},
                                            {"usable", report.comparison->usable()},
                                            {"word", word},
                                            {"brighter", brighter}});
    std::string heading = word + " and render";
    heading[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(heading[0])));
    return section("pictures", heading, body);
}

std::string maps_section(const Report& report) {
    if (!report.comparison) return {};
    const ComparedPictures& p = report.comparison->pictures;
    std::vector<View> figures;
    const auto add = [&](const PixelMap& map, auto&&... parts) {
        if (!map.values.empty()) figures.push_back(map_figure(map, parts...));
    };
    add(p.luminance_difference, ColourMap::difference, -0.5, 0.5, "Brightness",
        "Render minus " + photo_word(report) + ", encoded luminance.",
        colour_bar(ColourMap::difference, "blue: render too dark, red: too bright", "−0.5", "0",
                   "+0.5"));
    add(p.colour_difference, ColourMap::error, 0, 30, "Colour", "CIEDE2000 of each pixel.",
        colour_bar(ColourMap::error, "1 is just visible, 10 is plain", "0", "15", "≥ 30"));
    add(p.visible_difference, ColourMap::error, 0, 1, "To the eye",
        "FLIP: what shows when the two are flicked between.",
        colour_bar(ColourMap::error, "bright: plain to see", "0", "0.5", "1"));
    add(p.similarity, ColourMap::likeness, 0, 1, "Structure", "SSIM of each pixel's neighbourhood.",
        colour_bar(ColourMap::likeness, "dark: alike", "≤ 0", "0.5", "1"));
    if (report.comparison->within)
        add(report.comparison->within->map, ColourMap::error, 0, 1.25,
            "What the readings leave open",
            fmt::format("Luminance against stones drawn from the fit's uncertainty, "
                        "as this camera would show them: {} % of the pixels are within one sigma, "
                        "{} % within two. Of a stone that the readings allow, 68 % and 95 % are.",
                        decimals(100 * report.comparison->within->within_one, 0),
                        decimals(100 * report.comparison->within->within_two, 0)),
            colour_bar(ColourMap::error,
                       "dark: within one sigma, purple: within two, bright: outside", "1", "2",
                       "more"));
    if (figures.empty()) return {};
    return section("maps", "Where they differ",
                   filled(templates::report_maps, {{"figures", figures}}));
}

}  // namespace culet
