#include "compare/scores/structure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/quality/qualitygmsd.hpp>

namespace culet {

namespace {

constexpr int k_steps = 64;

struct Range {
    double low = 0, high = 0;
    // The last step includes its upper end.
    int step(float value) const {
        if (!(high > low)) return 0;
        const double share = (static_cast<double>(value) - low) / (high - low);
        return std::clamp(static_cast<int>(k_steps * share), 0, k_steps - 1);
    }
};

Range range_of(const cv::Mat& plane, const cv::Mat& mask) {
    Range range;
    cv::minMaxLoc(plane, &range.low, &range.high, nullptr, nullptr, mask);
    return range;
}

double entropy(const double* counts, std::size_t size, double total) {
    double sum = 0;
    for (std::size_t i = 0; i < size; ++i) {
        if (counts[i] > 0) sum -= counts[i] / total * std::log(counts[i] / total);
    }
    return sum;
}

}  // namespace

std::optional<double> gmsd(const ShownPictures& pictures, const cv::Mat& mask) {
    // OpenCV's constant is for 0..255. Outside the stone both pictures are black, so that the
    // surroundings do not matter.
    cv::Mat photo(mask.size(), CV_8U, cv::Scalar(0)), render = photo.clone(), bytes;
    pictures.photo_luma.convertTo(bytes, CV_8U, 255);
    bytes.copyTo(photo, mask);
    pictures.render_luma.convertTo(bytes, CV_8U, 255);
    bytes.copyTo(render, mask);
    if (mask.rows < 4 || mask.cols < 4) return std::nullopt;
    cv::Mat map, inside;
    cv::quality::QualityGMSD::compute(photo, render, map);
    // A pixel of the map depends on its own four pixels and their neighbours.
    cv::resize(mask, inside, map.size(), 0, 0, cv::INTER_AREA);
    inside = inside == 255;
    cv::erode(inside, inside, cv::Mat::ones(3, 3, CV_8U), {-1, -1}, 1, cv::BORDER_CONSTANT, 0);
    if (cv::countNonZero(inside) < 2) return std::nullopt;
    cv::Scalar mean, deviation;
    cv::meanStdDev(map, mean, deviation, inside);
    return deviation[0];
}

std::optional<double> normalized_information(const ShownPictures& pictures, const cv::Mat& mask) {
    if (cv::countNonZero(mask) == 0) return std::nullopt;
    const Range of_photo = range_of(pictures.photo_luma, mask),
                of_render = range_of(pictures.render_luma, mask);
    std::array<double, k_steps * k_steps> both{};
    std::array<double, k_steps> photo{}, render{};
    double total = 0;
    for (int y = 0; y < mask.rows; ++y) {
        for (int x = 0; x < mask.cols; ++x) {
            if (mask.at<unsigned char>(y, x) == 0) continue;
            const auto p =
                static_cast<std::size_t>(of_photo.step(pictures.photo_luma.at<float>(y, x)));
            const auto r =
                static_cast<std::size_t>(of_render.step(pictures.render_luma.at<float>(y, x)));
            ++both[p * k_steps + r];
            ++photo[p];
            ++render[r];
            ++total;
        }
    }
    const double joint = entropy(both.data(), both.size(), total);
    if (!(joint > 0)) return std::nullopt;
    return (entropy(photo.data(), photo.size(), total) +
            entropy(render.data(), render.size(), total)) /
           joint;
}

}  // namespace culet
