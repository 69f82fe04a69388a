#include "compare/scores/aligned_pair.h"

#include <algorithm>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "compare/photo/pixels.h"

namespace culet {

namespace {

// A sample within 1 % of the clipping level counts as clipped, because JPEGs round there.
constexpr double k_clipped = 0.99;

// Share of the diameter, for the longest wavelets. Blurs of light that reach as far use nothing
// outside the mask.
constexpr double k_around = 0.06;
// SSIM's window reaches five pixels.
constexpr int k_least_around = 6;

cv::Mat eroded(const cv::Mat& mask, double by_px) {
    cv::Mat distance;
    cv::distanceTransform(mask, distance, cv::DIST_L2, cv::DIST_MASK_PRECISE, CV_32F);
    return distance > by_px;
}

}  // namespace

cv::Rect part_to_score(const MatchedPictures& pictures) {
    const cv::Rect box = cv::boundingRect(pictures.mask);
    const int around =
        std::max(k_least_around, static_cast<int>(std::ceil(k_around * pictures.diameter)));
    // Even bounds, so that scores that halve the pictures pair the same pixels.
    const auto even = [](int at) { return std::max(0, at - at % 2); };
    const cv::Point corner(even(box.x - around), even(box.y - around));
    const cv::Point far(even(box.x + box.width + around + 1),
                        even(box.y + box.height + around + 1));
    return cv::Rect(corner, far) & cv::Rect({0, 0}, pictures.mask.size());
}

MatchedPictures part_of(const MatchedPictures& pictures, const cv::Rect& part) {
    MatchedPictures result = pictures;
    result.photo = pictures.photo(part).clone();
    result.render = pictures.render(part).clone();
    result.mask = pictures.mask(part).clone();
    return result;
}

double white_level(const cv::Mat& colour, const cv::Mat& mask, double saturation) {
    if (saturation > 0) return saturation;
    return std::max(1e-30, quantile(brightest_channel(colour), mask, 0.995));
}

cv::Mat not_clipped(const cv::Mat& colour, double saturation, const cv::Mat& mask) {
    if (saturation <= 0) return mask.clone();
    const cv::Mat below = brightest_channel(colour) < k_clipped * saturation;
    return below & mask;
}

void multiply_channels(cv::Mat& colour, const std::array<double, 3>& gain) {
    cv::multiply(colour, cv::Scalar(gain[0], gain[1], gain[2]), colour);
}

namespace {

void match_exposure(AlignedPair& pair) {
    const Frame& frame = pair.frame;
    if (frame.render.empty()) return;
    MatchedPictures& pictures = pair.pictures;
    pictures.photo = frame.photo.colour;
    pictures.render = frame.render.clone();
    pictures.diameter = frame.photo.silhouette.diameter;
    pictures.mask = eroded(frame.photo.silhouette.mask & frame.render_mask,
                           std::max(2.0, 0.005 * pictures.diameter));
    if (!frame.photo.ignored.empty()) pictures.mask.setTo(0, frame.photo.ignored);
    pair.compared_pixels = cv::countNonZero(pictures.mask);
    if (!pair.enough()) return;
    pictures.white = white_level(pictures.photo, pictures.mask, pair.photo_saturation);
    const cv::Mat photo_usable = not_clipped(pictures.photo, pair.photo_saturation, pictures.mask);
    pair.usable = not_clipped(pictures.render, pair.render_saturation, photo_usable);
    pair.saturated = 1 - static_cast<double>(cv::countNonZero(photo_usable)) / pair.compared_pixels;
    pair.gain = solve_gain(pictures.photo, pictures.render, pair.usable);
    multiply_channels(pictures.render, pair.gain);
}

}  // namespace

AlignedPair aligned(const Photo& photo, const Photo& render, double largest) {
    AlignedPair pair;
    pair.frame = align(photo, render, largest);
    pair.photo_saturation = photo.saturation;
    pair.render_saturation = render.saturation;
    match_exposure(pair);
    return pair;
}

AlignedPair with_render(AlignedPair pair, const Photo& render) {
    pair.frame.render = moved_as_render(pair.frame, render);
    pair.render_saturation = render.saturation;
    match_exposure(pair);
    return pair;
}

}  // namespace culet
