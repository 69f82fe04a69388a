#include "compare/calibration/photo_noise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "compare/scores/chance.h"
#include "render/colour/colour.h"

namespace culet {
namespace {

constexpr int k_size = 200, k_tile = 13;
constexpr double k_white = 2, k_psf_px = 0.7;

// Facets' images: uniform tiles, some nearly black, some over white, moved by `off` pixels as on a
// stone whose facets differ from the model's.
cv::Mat mosaic(int off) {
    cv::Mat tiles(k_size / k_tile + 2, k_size / k_tile + 2, CV_32FC3),
        picture(k_size, k_size, CV_32FC3);
    Chance chance(7);
    for (cv::Vec3f& tile : cv::Mat_<cv::Vec3f>(tiles)) {
        for (int i = 0; i < 3; ++i) tile[i] = static_cast<float>(chance.uniform(0, 1.1 * k_white));
    }
    for (int y = 0; y < k_size; ++y) {
        for (int x = 0; x < k_size; ++x) {
            picture.at<cv::Vec3f>(y, x) =
                tiles.at<cv::Vec3f>((y + off) / k_tile, (x + off) / k_tile);
        }
    }
    return picture;
}

// Shot noise for so many electrons at white, and the quantisation of a file.
MatchedPictures pictures_of(double electrons, int bits, int off) {
    MatchedPictures result;
    result.white = k_white;
    result.diameter = k_size;
    result.mask = cv::Mat(k_size, k_size, CV_8U, cv::Scalar(255));
    result.render = mosaic(0);
    cv::GaussianBlur(mosaic(off), result.photo, {0, 0}, k_psf_px);
    Chance chance(11);
    for (cv::Vec3f& pixel : cv::Mat_<cv::Vec3f>(result.photo)) {
        for (int i = 0; i < 3; ++i) {
            const double signal = static_cast<double>(pixel[i]) / k_white;
            double value = signal;
            if (electrons > 0) value += std::sqrt(signal / electrons) * chance.normal();
            value = std::clamp(value, 0.0, 1.0);
            if (bits > 0) {
                const double steps = std::ldexp(1.0, bits) - 1;
                value = srgb_decoded(std::round(srgb_encoded(value) * steps) / steps);
            }
            pixel[i] = static_cast<float>(value * k_white);
        }
    }
    return result;
}

// The lower quartile of n absolute normal values, q = 0.3186, has a relative error of sqrt(3 / 16 /
// n) / p(q) with the density p(q) = 2 * 0.3792: 1.79 / sqrt(n). The filter mixes nine pixels; with
// 40000 pixels and three colours, a tenth of them too dark or bright, n is at least 10000: 1.8 %.
// Allowed are four of these for the noise, twice that for its square.
TEST(PhotoNoise, IsThatOfTheElectrons) {
    for (const double electrons : {400.0, 2500.0, 10000.0, 40000.0}) {
        EXPECT_NEAR(photo_electrons(pictures_of(electrons, 16, 0), k_psf_px, 16) / electrons, 1,
                    0.15)
            << electrons;
    }
}

// Facets' edges in other places are not noise.
TEST(PhotoNoise, IsTheSameWhereTheStoneIsNotQuiteTheModel) {
    for (const int off : {1, 3}) {
        EXPECT_NEAR(photo_electrons(pictures_of(10000, 16, off), k_psf_px, 16) / 10000, 1, 0.15)
            << off;
    }
}

// Steps of 8 bits are one and a half times the noise of 40000 electrons.
TEST(PhotoNoise, IsToldFromAFilesSteps) {
    for (const double electrons : {2500.0, 10000.0, 40000.0}) {
        EXPECT_NEAR(photo_electrons(pictures_of(electrons, 8, 0), k_psf_px, 8) / electrons, 1, 0.15)
            << electrons;
    }
}

TEST(PhotoNoise, OfAPictureWithoutAnyIsTheLeastThereIs) {
    EXPECT_EQ(photo_electrons(pictures_of(0, 0, 0), k_psf_px, 0), 1e6);
}

TEST(PhotoNoise, OfAPhotographThatShowsNothingIsTheLeastThereIs) {
    MatchedPictures dark = pictures_of(10000, 8, 0);
    dark.photo *= 1e-3;
    EXPECT_EQ(photo_electrons(dark, k_psf_px, 8), 1e6);
    MatchedPictures nothing = pictures_of(10000, 8, 0);
    nothing.mask.setTo(0);
    EXPECT_EQ(photo_electrons(nothing, k_psf_px, 8), 1e6);
}

TEST(PhotoNoise, AndBlurAreGivenToACameraInSteps) {
    CameraModel camera;
    camera.bits = 16;
    set_blur_and_noise(camera, pictures_of(10000, 16, 0));
    // Good to some 0.3 pixels (photo_blur.h); the noise depends slightly on the blur.
    EXPECT_NEAR(camera.psf_px, k_psf_px, 0.3);
    EXPECT_NEAR(camera.psf_px * 10, std::round(camera.psf_px * 10), 1e-9);
    EXPECT_NEAR(std::log2(camera.electrons / 10000), 0, 0.5);
    EXPECT_NEAR(std::log2(camera.electrons) * 4, std::round(std::log2(camera.electrons) * 4), 1e-9);
}

}  // namespace
}  // namespace culet
