#include "compare/photo/pixels.h"

#include <algorithm>
#include <array>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "render/colour/colour.h"
#include "render/image/codecs/codecs.h"
#include "stone/numbers/quantile.h"
#include "stone/text/errors.h"

namespace culet {

cv::Mat colour_of(const Photo& photo) {
    return cv::Mat(photo.height, photo.width, CV_32FC3, const_cast<float*>(photo.rgb.data()));
}

cv::Mat luminance(const cv::Mat& colour) {
    cv::Mat result;
    cv::transform(colour, result, cv::Matx13f(0.2126f, 0.7152f, 0.0722f));
    return result;
}

cv::Mat encoded(const cv::Mat& linear) {
    // A table over the square root, fine enough (5e-7) that its steps never show.
    static const auto table = [] {
        std::vector<float> values(4098);
        for (std::size_t i = 0; i < values.size(); ++i) {
            const double root = static_cast<double>(i) / 4096;
            values[i] = static_cast<float>(srgb_encoded(root * root));
        }
        return values;
    }();
    cv::Mat result(linear.size(), linear.type());
    const int samples = linear.cols * linear.channels();
    for (int y = 0; y < linear.rows; ++y) {
        const float* from = linear.ptr<float>(y);
        float* to = result.ptr<float>(y);
        for (int i = 0; i < samples; ++i) {
            const float at = 4096 * std::sqrt(std::clamp(from[i], 0.0f, 1.0f));
            const auto cell = static_cast<std::size_t>(at);
            const float part = at - static_cast<float>(cell);
            to[i] = (1 - part) * table[cell] + part * table[cell + 1];
        }
    }
    return result;
}

std::string png_bytes(const cv::Mat& pixels) {
    const cv::Mat rows = pixels.isContinuous() ? pixels : pixels.clone();
    return encode_png(rows.cols, rows.rows, rows.channels(),
                      {rows.data, rows.total() * rows.elemSize()});
}

double between_pixels(const cv::Mat& plane, double x, double y, cv::Point2d* slope) {
    x = std::clamp(x, 0.0, plane.cols - 1.001);
    y = std::clamp(y, 0.0, plane.rows - 1.001);
    const int column = static_cast<int>(x), row = static_cast<int>(y);
    const double u = x - column, v = y - row;
    const float *above = plane.ptr<float>(row) + column,
                *below = plane.ptr<float>(row + 1) + column;
    const double a = above[0], b = above[1], c = below[0], d = below[1];
    if (slope) *slope = {(1 - v) * (b - a) + v * (d - c), (1 - u) * (c - a) + u * (d - b)};
    return (1 - v) * ((1 - u) * a + u * b) + v * ((1 - u) * c + u * d);
}

cv::Mat brightest_channel(const cv::Mat& colour) {
    cv::Mat channels[3];
    cv::split(colour, channels);
    return cv::max(cv::max(channels[0], channels[1]), channels[2]);
}

double quantile(const cv::Mat& plane, const cv::Mat& mask, double share) {
    std::vector<float> values;
    for (int y = 0; y < plane.rows; ++y) {
        const float* p = plane.ptr<float>(y);
        const unsigned char* m = mask.empty() ? nullptr : mask.ptr<unsigned char>(y);
        for (int x = 0; x < plane.cols; ++x) {
            if (m == nullptr || m[x] != 0) values.push_back(p[x]);
        }
    }
    return values.empty() ? 0 : static_cast<double>(quantile(std::move(values), share));
}

}  // namespace culet
