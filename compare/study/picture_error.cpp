#include "compare/study/picture_error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/core.hpp>

#include "compare/photo/pixels.h"
#include "compare/scores/flip.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

// As in colour_error.h: middle grey is a fifth of white.
constexpr double k_white = 5;

cv::Mat colour_of(const Picture& picture) {
    return cv::Mat(picture.height, picture.width, CV_32FC3, const_cast<float*>(picture.rgb.data()));
}

template <class Visit>
void each_stone_pixel(const cv::Mat& mask, Visit&& visit) {
    for (int y = 0; y < mask.rows; ++y) {
        for (int x = 0; x < mask.cols; ++x) {
            if (mask.at<unsigned char>(y, x) != 0) visit(y, x);
        }
    }
}

}  // namespace

PictureMetric::PictureMetric(Picture truth) : truth_(std::move(truth)) {
    matched_.photo = colour_of(truth_);
    matched_.mask = cv::Mat(truth_.height, truth_.width, CV_8U, cv::Scalar(255));
    for (int y = 0; y < truth_.height && !truth_.coverage.empty(); ++y) {
        for (int x = 0; x < truth_.width; ++x) {
            const std::size_t at = static_cast<std::size_t>(y) * truth_.width + x;
            if (!(truth_.coverage[at] > 0)) matched_.mask.at<unsigned char>(y, x) = 0;
        }
    }
    stone_pixels_ = cv::countNonZero(matched_.mask);
    matched_.diameter = 2 * std::sqrt(stone_pixels_ / M_PI);
    if (stone_pixels_ > 0) {
        const cv::Scalar mean = cv::mean(matched_.photo, matched_.mask);
        mean_ = (mean[0] + mean[1] + mean[2]) / 3;
    }
    matched_.white = k_white * mean_;
    if (!(matched_.white > 0)) matched_.white = 1;
}

PictureError PictureMetric::error_of(const Picture& picture) const {
    check(picture.width == truth_.width && picture.height == truth_.height,
          "pictures of one study have one size");
    MatchedPictures both = matched_;
    both.render = colour_of(picture);
    PictureError error;
    double sum = 0, squares = 0;
    each_stone_pixel(both.mask, [&](int y, int x) {
        const cv::Vec3f d = both.render.at<cv::Vec3f>(y, x) - both.photo.at<cv::Vec3f>(y, x);
        for (int c = 0; c < 3; ++c) {
            const double off = std::abs(static_cast<double>(d[c]));
            sum += off;
            squares += off * off;
        }
    });
    const double values = 3.0 * stone_pixels_;
    // A black picture has no scale, so any difference is infinite.
    const auto relative = [&](double off) { return off > 0 ? off / mean_ : 0; };
    error.mean = relative(sum / values);
    error.rmse = relative(std::sqrt(squares / values));
    error.psnr = psnr(shown(both), both.mask);
    const ColourScore colour = deltaE00(both);
    error.delta_e_mean = colour.mean;
    error.delta_e_95 = colour.percentile_95;
    error.flip = flip(both).mean;
    return error;
}

PixelMap PictureMetric::difference(const Picture& picture) const {
    PixelMap map{truth_.width, truth_.height,
                 std::vector<float>(truth_.pixels(), std::numeric_limits<float>::quiet_NaN())};
    const cv::Mat d = luminance(colour_of(picture)) - luminance(matched_.photo);
    each_stone_pixel(matched_.mask, [&](int y, int x) {
        map.values[static_cast<std::size_t>(y) * map.width + x] =
            static_cast<float>(static_cast<double>(d.at<float>(y, x)) / mean_);
    });
    return map;
}

}  // namespace culet
