#include "compare/scores/flip.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "render/colour/colour_difference.h"

namespace culet {

namespace {

// Contrast sensitivity as Gaussians a sqrt(pi / b) exp(-pi^2 r^2 / b), r in degrees (section 4.1.1,
// table 1): luminance, red-green, blue-yellow (a sum of two).
struct Sensitivity {
    double a, b;
};
constexpr Sensitivity k_luminance{1, 0.0047}, k_red_green{1, 0.0053}, k_blue_yellow{34.1, 0.04},
    k_blue_yellow_narrow{13.5, 0.025};

double sigma_px(const Sensitivity& s, double pixels_per_degree) {
    return pixels_per_degree * std::sqrt(s.b / 2) / std::numbers::pi;
}

// Filters all channels out to three sigma of the widest, as the authors' program does.
cv::Mat blurred(const cv::Mat& plane, double sigma, int radius) {
    cv::Mat result;
    cv::GaussianBlur(plane, result, {2 * radius + 1, 2 * radius + 1}, sigma, sigma,
                     cv::BORDER_REPLICATE);
    return result;
}

// sRGB primaries to XYZ over the white point (IEC 61966-2-1).
const cv::Matx33f k_xyz{0.4124f / 0.9505f, 0.3576f / 0.9505f, 0.1805f / 0.9505f,
                        0.2126f,           0.7152f,           0.0722f,
                        0.0193f / 1.0890f, 0.1192f / 1.0890f, 0.9505f / 1.0890f};

// Y Cx Cz (equation 1) without their constant factors, which do not matter to linear filters.
const cv::Matx33f k_opponent{0, 1, 0, 1, -1, 0, 0, 1, -1};

struct Seen {
    cv::Mat hunt;       // CV_32FC3: L*, a*, b* with Hunt's adjustment (equation 3)
    cv::Mat luminance;  // Y before filtering
};

Seen seen(const cv::Mat& linear, const cv::Mat& asked, double pixels_per_degree) {
    cv::Mat opponent;
    cv::Mat clipped = cv::min(cv::max(linear, 0), cv::Scalar(1, 1, 1));
    const cv::Matx33f forward = k_opponent * k_xyz;
    cv::transform(clipped, opponent, forward);
    cv::Mat planes[3];
    cv::split(opponent, planes);
    const int radius = static_cast<int>(std::ceil(3 * sigma_px(k_blue_yellow, pixels_per_degree)));
    Seen result;
    result.luminance = planes[0].clone();
    planes[0] = blurred(planes[0], sigma_px(k_luminance, pixels_per_degree), radius);
    planes[1] = blurred(planes[1], sigma_px(k_red_green, pixels_per_degree), radius);
    // The two Gaussians are weighted by their volumes: height a sqrt(pi / b), area b / pi.
    const double wide = k_blue_yellow.a * std::sqrt(k_blue_yellow.b);
    const double narrow = k_blue_yellow_narrow.a * std::sqrt(k_blue_yellow_narrow.b);
    planes[2] =
        (wide * blurred(planes[2], sigma_px(k_blue_yellow, pixels_per_degree), radius) +
         narrow * blurred(planes[2], sigma_px(k_blue_yellow_narrow, pixels_per_degree), radius)) /
        (wide + narrow);
    cv::merge(planes, 3, opponent);
    cv::Mat back;
    cv::transform(opponent, back, forward.inv());
    result.hunt.create(linear.size(), CV_32FC3);
    for (int y = 0; y < back.rows; ++y) {
        for (int x = 0; x < back.cols; ++x) {
            if (asked.at<unsigned char>(y, x) == 0) continue;
            const cv::Vec3f c = back.at<cv::Vec3f>(y, x);
            const auto part = [&](int i) {
                return std::clamp(static_cast<double>(c[i]), 0.0, 1.0);
            };
            const Lab lab = lab_from_linear_srgb(part(0), part(1), part(2));
            const double hunt = 0.01 * lab.L;
            result.hunt.at<cv::Vec3f>(y, x) = {static_cast<float>(lab.L),
                                               static_cast<float>(hunt * lab.a),
                                               static_cast<float>(hunt * lab.b)};
        }
    }
    return result;
}

// HyAB (equation 4): the lightness difference plus the chromatic distance.
double hyab(const cv::Vec3f& p, const cv::Vec3f& q) {
    const cv::Vec3f d = p - q;
    return std::abs(static_cast<double>(d[0])) +
           std::hypot(static_cast<double>(d[1]), static_cast<double>(d[2]));
}

// The largest possible difference: green against blue (section 4.1.2).
double largest_difference() {
    const auto hunt = [](double r, double g, double b) {
        const Lab lab = lab_from_linear_srgb(r, g, b);
        return cv::Vec3f(static_cast<float>(lab.L), static_cast<float>(0.01 * lab.L * lab.a),
                         static_cast<float>(0.01 * lab.L * lab.b));
    };
    return std::pow(hyab(hunt(0, 1, 0), hunt(0, 0, 1)), 0.7);
}

// Equations 5 and 6: 0.4 of the largest difference is mapped to 0.95 of the scale.
double colour_difference(double apart, double largest) {
    const double powered = std::pow(apart, 0.7), knee = 0.4 * largest;
    if (powered < knee) return powered * 0.95 / knee;
    return 0.95 + (powered - knee) / (largest - knee) * 0.05;
}

// One-dimensional Gaussian and its derivatives; positive and negative weights each sum to one.
struct FeatureKernels {
    cv::Mat smooth, edge, point;
};

FeatureKernels feature_kernels(double pixels_per_degree) {
    const double sigma = 0.5 * 0.082 * pixels_per_degree;  // section 4.2
    const int radius = static_cast<int>(std::ceil(3 * sigma));
    FeatureKernels kernels;
    for (cv::Mat* kernel : {&kernels.smooth, &kernels.edge, &kernels.point}) {
        kernel->create(2 * radius + 1, 1, CV_32F);
    }
    for (int i = -radius; i <= radius; ++i) {
        const double g = std::exp(-i * i / (2 * sigma * sigma));
        kernels.smooth.at<float>(i + radius) = static_cast<float>(g);
        kernels.edge.at<float>(i + radius) = static_cast<float>(-i * g);
        kernels.point.at<float>(i + radius) = static_cast<float>((i * i / (sigma * sigma) - 1) * g);
    }
    for (cv::Mat* kernel : {&kernels.smooth, &kernels.edge, &kernels.point}) {
        double positive = 0, negative = 0;
        for (int i = 0; i < kernel->rows; ++i) {
            const double w = static_cast<double>(kernel->at<float>(i));
            (w > 0 ? positive : negative) += std::abs(w);
        }
        for (int i = 0; i < kernel->rows; ++i) {
            float& w = kernel->at<float>(i);
            w /= static_cast<float>(w > 0 ? positive : negative);
        }
    }
    return kernels;
}

// Magnitude of a feature detector's two directional responses.
cv::Mat feature(const cv::Mat& luminance, const cv::Mat& kernel, const cv::Mat& smooth) {
    cv::Mat across, down, length;
    cv::sepFilter2D(luminance, across, CV_32F, kernel, smooth, {-1, -1}, 0, cv::BORDER_REPLICATE);
    cv::sepFilter2D(luminance, down, CV_32F, smooth, kernel, {-1, -1}, 0, cv::BORDER_REPLICATE);
    cv::magnitude(across, down, length);
    return length;
}

}  // namespace

cv::Mat flip_map(const cv::Mat& first, const cv::Mat& second, double pixels_per_degree) {
    return flip_map(first, second, cv::Mat(first.size(), CV_8U, cv::Scalar(255)),
                    pixels_per_degree);
}

cv::Mat flip_map(const cv::Mat& first, const cv::Mat& second, const cv::Mat& asked,
                 double pixels_per_degree) {
    const Seen a = seen(first, asked, pixels_per_degree),
               b = seen(second, asked, pixels_per_degree);
    const FeatureKernels kernels = feature_kernels(pixels_per_degree);
    cv::Mat edges, points;
    cv::absdiff(feature(a.luminance, kernels.edge, kernels.smooth),
                feature(b.luminance, kernels.edge, kernels.smooth), edges);
    cv::absdiff(feature(a.luminance, kernels.point, kernels.smooth),
                feature(b.luminance, kernels.point, kernels.smooth), points);
    const cv::Mat features = cv::max(edges, points);
    const double largest = largest_difference();
    cv::Mat map = cv::Mat::zeros(first.size(), CV_32F);
    for (int y = 0; y < map.rows; ++y) {
        for (int x = 0; x < map.cols; ++x) {
            if (asked.at<unsigned char>(y, x) == 0) continue;
            const double colour = colour_difference(
                hyab(a.hunt.at<cv::Vec3f>(y, x), b.hunt.at<cv::Vec3f>(y, x)), largest);
            // Equations 8 and 9: where features differ, colours count more.
            const double different = std::sqrt(
                std::min(1.0, static_cast<double>(features.at<float>(y, x)) / std::numbers::sqrt2));
            map.at<float>(y, x) = static_cast<float>(std::pow(colour, 1 - different));
        }
    }
    return map;
}

ScoreMap flip(const MatchedPictures& pictures) {
    const auto alone = [&](const cv::Mat& colour) {
        cv::Mat result = cv::Mat::zeros(colour.size(), colour.type());
        const cv::Mat scaled = colour * (1 / pictures.white);
        scaled.copyTo(result, pictures.mask);
        return result;
    };
    ScoreMap result;
    result.map = flip_map(alone(pictures.photo), alone(pictures.render), pictures.mask);
    double sum = 0, count = 0;
    for (int y = 0; y < result.map.rows; ++y) {
        for (int x = 0; x < result.map.cols; ++x) {
            if (pictures.mask.at<unsigned char>(y, x) == 0) continue;
            sum += static_cast<double>(result.map.at<float>(y, x));
            ++count;
        }
    }
    result.mean = count > 0 ? sum / count : 0;
    return result;
}

}  // namespace culet
