#include "compare/scores/open_bands.h"

#include <limits>
#include <opencv2/core.hpp>

#include "compare/registration/frame.h"
#include "render/colour/colour.h"

namespace culet {

namespace {

// Three of the bands' levels as a picture, which is laid on the photograph as the render was.
cv::Mat moved_levels(const AlignedPair& pair, const Photo& render,
                     const std::array<std::size_t, 3>& levels) {
    Photo picture;
    picture.width = render.width;
    picture.height = render.height;
    picture.coverage = render.coverage;
    for (std::size_t p = 0; p < render.bands.size() / 4; ++p) {
        for (const std::size_t level : levels) picture.rgb.push_back(render.bands[4 * p + level]);
    }
    return moved_as_render(pair.frame, picture);
}

// The photograph's light as the render has it.
double light_in_render(const cv::Vec3f& photo, const std::array<double, 3>& gain) {
    return luminance({photo[0] / gain[0], photo[1] / gain[1], photo[2] / gain[2]});
}

}  // namespace

std::optional<WithinReadings> within_readings(const AlignedPair& pair, const Photo& render) {
    if (render.bands.empty() || pair.pictures.photo.empty()) return std::nullopt;
    const cv::Mat outer = moved_levels(pair, render, {0, 1, 3}),
                  upper = moved_levels(pair, render, {2, 2, 2});
    const cv::Mat& photo = pair.pictures.photo;
    WithinReadings result;
    result.map = {photo.cols, photo.rows, {}};
    for (int y = 0; y < photo.rows; ++y) {
        for (int x = 0; x < photo.cols; ++x) {
            float& shown = result.map.values.emplace_back(std::numeric_limits<float>::quiet_NaN());
            if (pair.usable.at<unsigned char>(y, x) == 0) continue;
            const double light = light_in_render(photo.at<cv::Vec3f>(y, x), pair.gain);
            const auto& band = outer.at<cv::Vec3f>(y, x);
            const double high = upper.at<cv::Vec3f>(y, x)[0];
            ++result.pixels;
            const bool one = light >= band[1] && light <= high;
            const bool two = light >= band[0] && light <= band[2];
            if (one) ++result.within_one;
            if (one || two) ++result.within_two;
            shown = one ? 0.0f : two ? 0.5f : 1.0f;
        }
    }
    if (result.pixels == 0) return std::nullopt;
    result.within_one /= result.pixels;
    result.within_two /= result.pixels;
    return result;
}

}  // namespace culet
