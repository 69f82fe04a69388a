#include "compare/light_probe/map_holes.h"

#include <limits>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "render/scene/environment_layout.h"

namespace culet {

namespace {

cv::Mat on_each_channel(const cv::Mat& plane) {
    cv::Mat three;
    cv::merge(std::vector<cv::Mat>(3, plane), three);
    return three;
}

// Means over blocks of 2 x 2; an odd row or column is padded with zeros.
cv::Mat halved(const cv::Mat& picture) {
    cv::Mat even, half;
    cv::copyMakeBorder(picture, even, 0, picture.rows % 2, 0, picture.cols % 2, cv::BORDER_CONSTANT,
                       cv::Scalar::all(0));
    cv::resize(even, half, even.size() / 2, 0, 0, cv::INTER_AREA);
    return half;
}

// Pull-push (in the spirit of Grossman & Gortler 1998): fills texels of weight 0 with means over
// ever larger blocks, interpolated and periodic in azimuth.
cv::Mat with_holes_filled(const cv::Mat& rgb, const cv::Mat& weight) {
    if (rgb.total() == 1 || cv::countNonZero(weight) == static_cast<int>(weight.total()))
        return rgb;
    const cv::Mat block_weight = halved(weight);
    const cv::Mat blocks = with_holes_filled(
        halved(rgb.mul(on_each_channel(weight))) /
            on_each_channel(cv::max(block_weight, std::numeric_limits<double>::min())),
        block_weight);
    cv::Mat round, between;
    cv::copyMakeBorder(blocks, round, 0, 0, 1, 1, cv::BORDER_WRAP);
    cv::resize(round, between, round.size() * 2, 0, 0, cv::INTER_LINEAR);
    cv::Mat result = rgb.clone();
    between(cv::Rect({2, 0}, rgb.size())).copyTo(result, weight == 0);
    return result;
}

}  // namespace

double fill_holes(EnvironmentMap& map, const std::vector<double>& weight) {
    // Blocks are weighted by solid angle.
    cv::Mat known(map.height, map.width, CV_64F);
    double empty_sr = 0;
    for (int y = 0; y < map.height; ++y) {
        const double omega = lat_long_solid_angle(y, map.width, map.height);
        for (int x = 0; x < map.width; ++x) {
            const bool holds = weight[static_cast<std::size_t>(y) * map.width + x] > 0;
            known.at<double>(y, x) = holds ? omega : 0;
            if (!holds) empty_sr += omega;
        }
    }
    if (empty_sr == 0) return 0;
    cv::Mat own(map.height, map.width, CV_32FC3, map.rgb.data()), rgb;
    own.convertTo(rgb, CV_64F);
    with_holes_filled(rgb, known).convertTo(own, CV_32F);
    return empty_sr;
}

}  // namespace culet
