#include "compare/pose/picture_noise.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "compare/photo/pixels.h"

namespace culet {

double noise_of(const cv::Mat& picture, const cv::Mat& mask) {
    // Zero for planes and second-order changes; the squares of the weights sum to 36.
    const cv::Mat kernel = (cv::Mat_<float>(3, 3) << 1, -2, 1, -2, 4, -2, 1, -2, 1);
    cv::Mat response;
    cv::filter2D(picture, response, CV_32F, kernel);
    const cv::Mat size = cv::abs(response);
    const cv::Mat one_channel = size.reshape(1);
    cv::Mat channels;  // the mask, repeated for each channel
    if (!mask.empty()) {
        cv::merge(std::vector<cv::Mat>(3, mask), channels);
        channels = channels.reshape(1);
    }
    // The lower quartile of |normal| is 0.3186 sigma, and edges affect it least.
    return quantile(one_channel, channels, 0.25) / (6 * 0.3186);
}

double least_edge(const cv::Mat& strength, const cv::Mat& stone) {
    constexpr double k_step = 1.0 / 255;
    // Length of a noise vector in two directions: its lower quartile is 0.7585 sigma (Rayleigh).
    const double noise = quantile(strength, stone, 0.25) / 0.7585;
    return std::max(k_step, std::min(4 * noise, quantile(strength, stone, 0.7)));
}

}  // namespace culet
