#include "compare/scores/wavelet_similarity.h"

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
constexpr double k_octave = 0.65;  // sigma of log frequency as a ratio: about one octave
// K of equation 7 keeps flat regions, where both responses are noise, from counting as different: a
// quarter of an 8-bit step, squared.
constexpr double k_flat_part = 1e-6;

// Zero mean under the mask and zero outside, so that the outline is not an edge.
cv::Mat centred(const cv::Mat& luma, const cv::Mat& mask) {
    const double mean = cv::mean(luma, mask)[0];
    cv::Mat result = cv::Mat::zeros(luma.size(), CV_32F);
    const cv::Mat shifted = luma - mean;
    shifted.copyTo(result, mask);
    return result;
}

constexpr double k_spread = std::numbers::pi / k_directions;  // sigma of the direction

// Frequencies with a weight below 1 % are left out.
const double k_contour = std::sqrt(2 * std::log(100.0));  // sigmas

// The frequency band of the wavelet, in steps of one over the plane's size.
cv::Rect band_of(cv::Size size, double wavelength, double angle) {
    double low[2] = {1, 1}, high[2] = {-1, -1};
    constexpr int k_places = 64;
    for (int i = 0; i < k_places; ++i) {
        const double at = 2 * std::numbers::pi * i / k_places;
        const double frequency = std::pow(k_octave, k_contour * std::cos(at)) / wavelength;
        const double direction = angle + k_spread * k_contour * std::sin(at);
        const double uv[2] = {frequency * std::cos(direction), frequency * std::sin(direction)};
        for (int k = 0; k < 2; ++k) {
            low[k] = std::min(low[k], uv[k]);
            high[k] = std::max(high[k], uv[k]);
        }
    }
    const int sides[2] = {size.width, size.height};
    int first[2], last[2];
    for (int k = 0; k < 2; ++k) {
        first[k] = std::max(-(sides[k] - 1) / 2, static_cast<int>(std::floor(low[k] * sides[k])));
        last[k] = std::min(sides[k] / 2, static_cast<int>(std::ceil(high[k] * sides[k])));
    }
    return {first[0], first[1], last[0] - first[0] + 1, last[1] - first[1] + 1};
}

// One log-Gabor wavelet in the frequency plane: one-sided, so that its response is complex.
WaveletBank::Wavelet wavelet(cv::Size size, double wavelength, int direction) {
    const double angle = std::numbers::pi * direction / k_directions;
    WaveletBank::Wavelet made;
    made.wavelength_px = wavelength;
    made.band = band_of(size, wavelength, angle);
    made.places = {std::min(size.width, cv::getOptimalDFTSize(made.band.width)),
                   std::min(size.height, cv::getOptimalDFTSize(made.band.height))};
    made.filter.create(made.band.size(), CV_32F);
    for (int y = 0; y < made.band.height; ++y) {
        const double v = (made.band.y + y) / static_cast<double>(size.height);
        for (int x = 0; x < made.band.width; ++x) {
            const double u = (made.band.x + x) / static_cast<double>(size.width);
            const double frequency = std::hypot(u, v);
            double weight = 0;
            if (frequency > 0) {
                const double octaves = std::log(frequency * wavelength) / std::log(k_octave);
                const double off =
                    std::remainder(std::atan2(v, u) - angle, 2 * std::numbers::pi) / k_spread;
                weight = std::exp(-0.5 * (octaves * octaves + off * off));
            }
            // The inverse transform is scaled by the plane's size, not the band's.
            made.filter.at<float>(y, x) = static_cast<float>(weight / size.area());
        }
    }
    return made;
}

// The wavelet's response, CV_32FC2: real and imaginary part.
cv::Mat answer(const cv::Mat& spectrum, const WaveletBank::Wavelet& one) {
    cv::Mat band = cv::Mat::zeros(one.places, CV_32FC2);
    for (int y = 0; y < one.band.height; ++y) {
        const int row = (one.band.y + y + spectrum.rows) % spectrum.rows;
        const cv::Vec2f* from = spectrum.ptr<cv::Vec2f>(row);
        const float* weight = one.filter.ptr<float>(y);
        cv::Vec2f* to = band.ptr<cv::Vec2f>(y);
        for (int x = 0; x < one.band.width; ++x) {
            const int column = (one.band.x + x + spectrum.cols) % spectrum.cols;
            to[x] = {from[column][0] * weight[x], from[column][1] * weight[x]};
        }
    }
    cv::dft(band, band, cv::DFT_INVERSE);
    return band;
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
        // The shortest representable wavelength is two pixels; four stay clear of the grid.
        const double wavelength = std::max(4.0, part * diameter * bank.scale);
        for (int direction = 0; direction < k_directions; ++direction) {
            bank.wavelets.push_back(wavelet(bank.size, wavelength, direction));
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
    double sum = 0;
    for (const WaveletBank::Wavelet& one : bank.wavelets) {
        const cv::Mat p = answer(a, one), q = answer(b, one);
        // p q*, and the sum of both energies.
        cv::Mat both(one.places, CV_32FC3);
        for (int y = 0; y < both.rows; ++y) {
            const cv::Vec2f *left = p.ptr<cv::Vec2f>(y), *right = q.ptr<cv::Vec2f>(y);
            cv::Vec3f* to = both.ptr<cv::Vec3f>(y);
            for (int x = 0; x < both.cols; ++x) {
                const cv::Vec2f l = left[x], r = right[x];
                to[x] = {l[0] * r[0] + l[1] * r[1], l[1] * r[0] - l[0] * r[1],
                         l[0] * l[0] + l[1] * l[1] + r[0] * r[0] + r[1] * r[1]};
            }
        }
        const double across = static_cast<double>(bank.size.width) / both.cols;
        const double down = static_cast<double>(bank.size.height) / both.rows;
        const double sigma = one.wavelength_px / 2;
        cv::GaussianBlur(both, both, {0, 0}, sigma / across, sigma / down, cv::BORDER_REPLICATE);
        double of_wavelet = 0, count = 0;
        for (int y = 0; y < both.rows; ++y) {
            const auto row = static_cast<int>(std::lround(y * down));
            if (row >= inside.rows) break;
            for (int x = 0; x < both.cols; ++x) {
                const auto column = static_cast<int>(std::lround(x * across));
                if (column >= inside.cols) break;
                if (inside.at<unsigned char>(row, column) == 0) continue;
                const cv::Vec3d v = both.at<cv::Vec3f>(y, x);
                // |sum p q*|: any phase difference is allowed, but it must be constant over the
                // window.
                of_wavelet +=
                    (2 * std::sqrt(v[0] * v[0] + v[1] * v[1]) + k_flat_part) / (v[2] + k_flat_part);
                ++count;
            }
        }
        if (count > 0) sum += of_wavelet / count;
    }
    return sum / static_cast<double>(bank.wavelets.size());
}

}  // namespace culet
