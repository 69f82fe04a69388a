#include "compare/wavelet_similarity.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace culet {

namespace {

constexpr double k_largest_diameter = 256;
constexpr std::array k_wavelengths{0.03, 0.06};  // of the diameter
constexpr int k_directions = 6;
constexpr double k_octave = 0.65;  // sigma of log frequency, as a ratio: about one octave
// K of equation 7 keeps flat regions, where both answers are noise, from counting as different: the
// square of a quarter of an 8-bit step.
constexpr double k_flat = 1e-6;

// Zero mean under the mask and zero outside, so that the outline itself is no edge.
cv::Mat centred(const cv::Mat& luma, const cv::Mat& mask) {
    const double mean = cv::mean(luma, mask)[0];
    cv::Mat result = cv::Mat::zeros(luma.size(), CV_32F);
    const cv::Mat shifted = luma - mean;
    shifted.copyTo(result, mask);
    return result;
}

// One log-Gabor wavelet in the frequency plane: one-sided, so that its answer is complex.
cv::Mat wavelet(cv::Size size, double wavelength, int direction) {
    const double angle = std::numbers::pi * direction / k_directions;
    const double spread = std::numbers::pi / k_directions;  // sigma of the direction
    cv::Mat result(size, CV_32F);
    for (int y = 0; y < size.height; ++y) {
        const double v =
            (y <= size.height / 2 ? y : y - size.height) / static_cast<double>(size.height);
        for (int x = 0; x < size.width; ++x) {
            const double u =
                (x <= size.width / 2 ? x : x - size.width) / static_cast<double>(size.width);
            const double frequency = std::hypot(u, v);
            double weight = 0;
            if (frequency > 0) {
                const double octaves = std::log(frequency * wavelength) / std::log(k_octave);
                const double off =
                    std::remainder(std::atan2(v, u) - angle, 2 * std::numbers::pi) / spread;
                weight = std::exp(-0.5 * (octaves * octaves + off * off));
            }
            result.at<float>(y, x) = static_cast<float>(weight);
        }
    }
    return result;
}

// Real and imaginary part of the wavelet's answer.
std::array<cv::Mat, 2> answer(const cv::Mat& spectrum, const cv::Mat& filter) {
    cv::Mat both[2], product;
    cv::split(spectrum, both);
    cv::multiply(both[0], filter, both[0]);
    cv::multiply(both[1], filter, both[1]);
    cv::merge(both, 2, product);
    cv::Mat space;
    cv::dft(product, space, cv::DFT_INVERSE | cv::DFT_SCALE);
    cv::split(space, both);
    return {both[0], both[1]};
}

cv::Mat spectrum_of(const cv::Mat& plane, cv::Size size) {
    cv::Mat padded = cv::Mat::zeros(size, CV_32F), spectrum;
    const cv::Mat corner = padded(cv::Rect({0, 0}, plane.size()));
    plane.copyTo(corner);
    cv::dft(padded, spectrum, cv::DFT_COMPLEX_OUTPUT);
    return spectrum;
}

}  // namespace

WaveletBank wavelet_bank(cv::Size picture_size, double diameter) {
    WaveletBank bank;
    bank.scale = std::min(1.0, k_largest_diameter / diameter);
    bank.size = {
        cv::getOptimalDFTSize(static_cast<int>(std::ceil(picture_size.width * bank.scale))),
        cv::getOptimalDFTSize(static_cast<int>(std::ceil(picture_size.height * bank.scale)))};
    for (const double part : k_wavelengths) {
        // Two pixels are the shortest wave there is; four keep clear of the grid.
        const double wavelength = std::max(4.0, part * diameter * bank.scale);
        for (int direction = 0; direction < k_directions; ++direction) {
            bank.wavelets.push_back({wavelength, wavelet(bank.size, wavelength, direction)});
        }
    }
    return bank;
}

double cw_ssim(const ShownPictures& pictures, const cv::Mat& mask, const WaveletBank& bank) {
    cv::Mat photo = pictures.photo_luma, render = pictures.render_luma, inside = mask;
    if (bank.scale < 1) {
        cv::resize(pictures.photo_luma, photo, {}, bank.scale, bank.scale, cv::INTER_AREA);
        cv::resize(pictures.render_luma, render, photo.size(), 0, 0, cv::INTER_AREA);
        cv::resize(mask, inside, photo.size(), 0, 0, cv::INTER_NEAREST);
    }
    const cv::Mat a = spectrum_of(centred(photo, inside), bank.size);
    const cv::Mat b = spectrum_of(centred(render, inside), bank.size);
    double sum = 0, count = 0;
    for (const WaveletBank::Wavelet& one : bank.wavelets) {
        const auto p = answer(a, one.filter), q = answer(b, one.filter);
        const auto windowed = [&](const cv::Mat& plane) {
            const double sigma = one.wavelength_px / 2;
            cv::Mat mean;
            cv::GaussianBlur(plane, mean, {0, 0}, sigma, sigma, cv::BORDER_REPLICATE);
            return mean;
        };
        // |sum p q*|: the phase difference may be anything, but must be one over the window.
        const cv::Mat real = windowed(p[0].mul(q[0]) + p[1].mul(q[1]));
        const cv::Mat imaginary = windowed(p[1].mul(q[0]) - p[0].mul(q[1]));
        const cv::Mat energy =
            windowed(p[0].mul(p[0]) + p[1].mul(p[1]) + q[0].mul(q[0]) + q[1].mul(q[1]));
        for (int y = 0; y < photo.rows; ++y) {
            for (int x = 0; x < photo.cols; ++x) {
                if (inside.at<unsigned char>(y, x) == 0) continue;
                const double common = std::hypot(static_cast<double>(real.at<float>(y, x)),
                                                 static_cast<double>(imaginary.at<float>(y, x)));
                sum +=
                    (2 * common + k_flat) / (static_cast<double>(energy.at<float>(y, x)) + k_flat);
                ++count;
            }
        }
    }
    return count > 0 ? sum / count : 0;
}

}  // namespace culet
