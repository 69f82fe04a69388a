#include "compare/registration/background.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "stone/numbers/upper_median.h"

namespace culet {

namespace {

// Differences from the background in sRGB-encoded units (0..1). 0.02 is 5 of 255: above the
// rounding and JPEG noise of a dark box. On a light ground a soft shadow reaches about 0.06.
constexpr double k_dark_ground = 0.25;  // encoded luminance of the background
constexpr float k_least_difference_dark = 0.02f, k_least_difference_light = 0.06f;

struct Background {
    cv::Mat difference;  ///< CV_32F, largest over the channels
    float noise = 0;     ///< of the border's difference, one sigma
    double level = 0;    ///< mean encoded luminance
};

// A plane a + b x + c y through the border's pixels, refitted twice without outliers.
cv::Vec3d border_plane(const std::vector<cv::Vec3d>& places, const std::vector<double>& values) {
    cv::Vec3d plane(upper_median(values), 0, 0);
    for (int round = 0; round < 3; ++round) {
        std::vector<double> off(values.size());
        for (std::size_t i = 0; i < values.size(); ++i) {
            off[i] = std::abs(values[i] - places[i].dot(plane));
        }
        const double limit = std::max(1.0 / 255, 3 * 1.4826 * upper_median(off));
        cv::Matx33d normal = cv::Matx33d::zeros();
        cv::Vec3d right(0, 0, 0);
        for (std::size_t i = 0; i < values.size(); ++i) {
            if (off[i] > limit) continue;
            normal += places[i] * places[i].t();
            right += places[i] * values[i];
        }
        cv::Vec3d solution;
        if (cv::solve(normal, right, solution, cv::DECOMP_SVD)) plane = solution;
    }
    return plane;
}

Background background_of(const cv::Mat& shown) {
    const int w = shown.cols, h = shown.rows;
    const int ring = std::max(2, std::min(w, h) / 50);
    std::vector<cv::Vec3d> places;
    std::vector<cv::Vec3f> colours;
    for (int y = 0; y < h; ++y) {
        const bool edge_row = y < ring || y >= h - ring;
        for (int x = 0; x < w; ++x) {
            if (!edge_row && x >= ring && x < w - ring) continue;
            places.emplace_back(1, 2.0 * x / w - 1, 2.0 * y / h - 1);
            colours.push_back(shown.at<cv::Vec3f>(y, x));
        }
    }
    Background background;
    cv::Matx33d planes;  // one row for each channel
    for (int c = 0; c < 3; ++c) {
        std::vector<double> values(colours.size());
        for (std::size_t i = 0; i < values.size(); ++i) values[i] = colours[i][c];
        const cv::Vec3d plane = border_plane(places, values);
        for (int k = 0; k < 3; ++k) planes(c, k) = plane[k];
        background.level += plane[0] / 3;
    }
    background.difference.create(h, w, CV_32F);
    std::vector<float> at_border;
    for (int y = 0; y < h; ++y) {
        for (int x = 0; x < w; ++x) {
            const cv::Vec3d ground = planes * cv::Vec3d(1, 2.0 * x / w - 1, 2.0 * y / h - 1);
            const cv::Vec3f colour = shown.at<cv::Vec3f>(y, x);
            double most = 0;
            for (int c = 0; c < 3; ++c) most = std::max(most, std::abs(colour[c] - ground[c]));
            background.difference.at<float>(y, x) = static_cast<float>(most);
            const bool inside = y >= ring && y < h - ring && x >= ring && x < w - ring;
            if (!inside) at_border.push_back(static_cast<float>(most));
        }
    }
    background.noise = 1.4826f * upper_median(std::move(at_border));
    return background;
}

float least_difference(const Background& background) {
    float least = k_least_difference_dark;
    if (background.level > k_dark_ground) {
        // A third of Otsu's level excludes soft shadows and includes pale facets.
        cv::Mat bytes, ignored;
        background.difference.convertTo(bytes, CV_8U, 255);
        const double otsu = cv::threshold(bytes, ignored, 0, 255, cv::THRESH_OTSU) / 255;
        least = std::max(k_least_difference_light, static_cast<float>(otsu / 3));
    }
    return least;
}

// The largest of three channels' differences is about 1.8 sigma of one channel's noise (its median
// times 1.4826), so four of these are seven sigma.
float noise_limit(const Background& background) {
    return 4 * background.noise;
}

}  // namespace

Differing differing(const cv::Mat& shown) {
    Differing result;
    Background background = background_of(shown);
    for (const double sigma : {1.0, 2.0, 4.0}) {
        if (noise_limit(background) <= least_difference(background)) break;
        cv::Mat calmer;
        cv::GaussianBlur(shown, calmer, {0, 0}, sigma, sigma, cv::BORDER_REPLICATE);
        background = background_of(calmer);
        result.blur = sigma;
    }
    result.threshold = std::max(least_difference(background), noise_limit(background));
    result.mask = background.difference > result.threshold;
    result.difference = background.difference;
    return result;
}

}  // namespace culet
