#include "render/image/glare.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>

namespace culet {

namespace {

constexpr int k_fine = 9;  // sample points across pixels next to the light, where the spread is
                           // steep

// Part of one pixel's light that another gets, by their distance in columns and rows.
double weight(int x, int y, double degrees_per_pixel) {
    const double radians = degrees_per_pixel * std::numbers::pi / 180;
    const int fine = std::max(std::abs(x), std::abs(y)) <= 4 ? k_fine : 1;
    double sum = 0;
    for (int i = 0; i < fine; ++i) {
        for (int j = 0; j < fine; ++j) {
            const double dx = x + (i + 0.5) / fine - 0.5, dy = y + (j + 0.5) / fine - 0.5;
            sum += scattered_by_the_eye(degrees_per_pixel * std::hypot(dx, dy));
        }
    }
    return sum * radians * radians / (fine * fine);
}

// Convolution: the sum over all pixels of weight times value, at each pixel.
cv::Mat spread(const cv::Mat& values, const cv::Mat& kernel_spectrum) {
    cv::Mat padded = cv::Mat::zeros(kernel_spectrum.size(), CV_64F);
    values.copyTo(padded(cv::Rect(0, 0, values.cols, values.rows)));
    cv::dft(padded, padded, 0, values.rows);
    cv::mulSpectrums(padded, kernel_spectrum, padded, 0);
    cv::dft(padded, padded, cv::DFT_INVERSE | cv::DFT_SCALE, values.rows);
    return padded(cv::Rect(0, 0, values.cols, values.rows)).clone();
}

}  // namespace

double scattered_by_the_eye(double degrees) {
    const double beside = degrees + 0.02;
    return 0.478 * 20.91 / (beside * beside * beside) + 0.138 * 72.37 / (beside * beside);
}

void add_glare(std::vector<float>& rgb, const PictureSize& size, double strength,
               double degrees_per_pixel) {
    const int width = size.width, height = size.height;
    // The kernel wraps around the corner of an area large enough for all distances.
    cv::Mat kernel =
        cv::Mat::zeros(cv::getOptimalDFTSize(2 * height), cv::getOptimalDFTSize(2 * width), CV_64F);
    for (int y = 1 - height; y < height; ++y) {
        for (int x = 1 - width; x < width; ++x) {
            if (x == 0 && y == 0) continue;
            kernel.at<double>((y + kernel.rows) % kernel.rows, (x + kernel.cols) % kernel.cols) =
                weight(std::abs(x), std::abs(y), degrees_per_pixel);
        }
    }
    cv::dft(kernel, kernel);
    // A pixel loses what the others get from it: w (theirs - own), summed over all.
    const cv::Mat given = spread(cv::Mat::ones(height, width, CV_64F), kernel);
    double most = 0;
    cv::minMaxLoc(given, nullptr, &most);
    const double factor = std::min(strength, 1 / std::max(most, 1e-300));
    for (int c = 0; c < 3; ++c) {
        cv::Mat plane(height, width, CV_64F);
        for (int i = 0; i < height * width; ++i)
            plane.at<double>(i / width, i % width) =
                static_cast<double>(rgb[static_cast<std::size_t>(3 * i + c)]);
        const cv::Mat got = spread(plane, kernel);
        for (int i = 0; i < height * width; ++i) {
            const int y = i / width, x = i % width;
            const double own = plane.at<double>(y, x);
            const double seen =
                own + factor * (got.at<double>(y, x) - own * given.at<double>(y, x));
            rgb[static_cast<std::size_t>(3 * i + c)] = static_cast<float>(std::max(0.0, seen));
        }
    }
}

}  // namespace culet
