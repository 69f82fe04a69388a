// Scores against other programs' numbers and closed forms.

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "compare/photo/pixels.h"
#include "compare/scores/colour_distribution.h"
#include "compare/scores/flip.h"
#include "compare/scores/metrics.h"
#include "compare/scores/reflexes.h"
#include "compare/scores/structure.h"
#include "render/colour/colour.h"

namespace culet {
namespace {

// Two reproducible 8-bit pictures. Width 96, height 80; c = 0, 1, 2 is R, G, B.
cv::Mat bytes_by_formula(bool second) {
    cv::Mat picture(80, 96, CV_8UC3);
    for (int y = 0; y < picture.rows; ++y) {
        for (int x = 0; x < picture.cols; ++x) {
            for (int c = 0; c < 3; ++c) {
                const double shift = second ? 0.3 : 0, wide = second ? 120 : 127.5;
                double v = wide + 70 * std::sin(0.11 * x + 0.05 * y + c + shift) +
                           (second ? 30 : 35) * std::sin(0.37 * y - 0.23 * x + 2 * c + 2 * shift);
                if (second) v += (7 * x + 13 * y) % 17 - 8;
                picture.at<cv::Vec3b>(y, x)[c] =
                    cv::saturate_cast<unsigned char>(static_cast<int>(std::floor(v + 0.5)));
            }
        }
    }
    return picture;
}

cv::Mat channel(const cv::Mat& picture, int c) {
    cv::Mat plane, scaled;
    cv::extractChannel(picture, plane, c);
    plane.convertTo(scaled, CV_32F, 1 / 255.0);
    return scaled;
}

ShownPictures shown_bytes() {
    ShownPictures pictures;
    bytes_by_formula(false).convertTo(pictures.photo, CV_32F, 1 / 255.0);
    bytes_by_formula(true).convertTo(pictures.render, CV_32F, 1 / 255.0);
    pictures.photo_luma = channel(bytes_by_formula(false), 1);
    pictures.render_luma = channel(bytes_by_formula(true), 1);
    return pictures;
}

cv::Mat everywhere(const cv::Mat& like) {
    return cv::Mat(like.size(), CV_8U, cv::Scalar(255));
}

cv::Mat decoded(const cv::Mat& bytes) {
    cv::Mat linear(bytes.size(), CV_32FC3);
    for (int y = 0; y < bytes.rows; ++y) {
        for (int x = 0; x < bytes.cols; ++x) {
            for (int c = 0; c < 3; ++c) {
                linear.at<cv::Vec3f>(y, x)[c] =
                    static_cast<float>(srgb_decoded(bytes.at<cv::Vec3b>(y, x)[c] / 255.0));
            }
        }
    }
    return linear;
}

MatchedPictures linear_pair(const cv::Mat& photo, const cv::Mat& render) {
    MatchedPictures pictures;
    pictures.photo = photo;
    pictures.render = render;
    pictures.mask = everywhere(photo);
    pictures.diameter = photo.cols;
    return pictures;
}

// scikit-image 0.19.3, skimage.metrics.structural_similarity(a, b, gaussian_weights=True,
// sigma=1.5, use_sample_covariance=False, data_range=255) of the green channels. It leaves a border
// of 5 pixels out of the mean, as does the mask here.
TEST(Ssim, EqualsScikitImageWithTheSameSettings) {
    const ShownPictures pictures = shown_bytes();
    cv::Mat mask(pictures.photo_luma.size(), CV_8U, cv::Scalar(0));
    mask(cv::Rect(5, 5, mask.cols - 10, mask.rows - 10)).setTo(255);
    EXPECT_NEAR(ssim(pictures, mask).mean, 0.789274015, 1e-5);
}

// scikit-image 0.19.3, skimage.metrics.peak_signal_noise_ratio(a, b, data_range=255) of R G B.
TEST(Psnr, EqualsScikitImageWithTheSameSettings) {
    const ShownPictures pictures = shown_bytes();
    EXPECT_NEAR(*psnr(pictures, everywhere(pictures.photo_luma)), 21.248210604, 1e-4);
}

// scikit-image 0.19.3, skimage.metrics.normalized_mutual_information(a, b, bins=64).
TEST(NormalizedInformation, EqualsScikitImageWithTheSameBins) {
    const ShownPictures pictures = shown_bytes();
    EXPECT_NEAR(*normalized_information(pictures, everywhere(pictures.photo_luma)), 1.154984341,
                1e-3);
}

TEST(NormalizedInformation, IsTwoThroughAnyToneCurveAndNothingOfFlatPictures) {
    ShownPictures pictures = shown_bytes();
    // 64 distinct levels whatever the curve: the steps remain.
    pictures.photo_luma = cv::Mat(16, 64, CV_32F);
    for (int y = 0; y < 16; ++y) {
        for (int x = 0; x < 64; ++x) pictures.photo_luma.at<float>(y, x) = x < 32 ? 0.2f : 0.6f;
    }
    cv::pow(pictures.photo_luma, 2.2, pictures.render_luma);
    const cv::Mat mask = everywhere(pictures.photo_luma);
    EXPECT_NEAR(*normalized_information(pictures, mask), 2, 1e-12);
    pictures.photo_luma.setTo(0.5);
    pictures.render_luma.setTo(0.7);
    EXPECT_FALSE(normalized_information(pictures, mask).has_value());
    EXPECT_FALSE(normalized_information(pictures, cv::Mat::zeros(mask.size(), CV_8U)).has_value());
}

// The formulas of Andersson et al. (2020) independently in double precision with two-dimensional
// filters (numpy 1.24, scipy 1.10) and the constants of the authors' program: radius 10 for every
// contrast sensitivity, 9 for the features, edges repeated. 67 pixels per degree. The authors' own
// example pictures are not available.
TEST(Flip, EqualsAnIndependentImplementation) {
    const cv::Mat map =
        flip_map(decoded(bytes_by_formula(false)), decoded(bytes_by_formula(true)), 67);
    EXPECT_NEAR(cv::mean(map)[0], 0.390596, 1e-4);
    EXPECT_NEAR(map.at<float>(30, 40), 0.174346, 3e-4);
    EXPECT_NEAR(map.at<float>(0, 0), 0.457015, 3e-4);
    EXPECT_NEAR(map.at<float>(79, 95), 0.570811, 3e-4);
}

TEST(Gmsd, IsNothingForEqualPicturesAndGrowsWithABlur) {
    ShownPictures pictures = shown_bytes();
    const cv::Mat mask = everywhere(pictures.photo_luma);
    pictures.render_luma = pictures.photo_luma.clone();
    EXPECT_NEAR(*gmsd(pictures, mask), 0, 1e-9);
    cv::GaussianBlur(pictures.photo_luma, pictures.render_luma, {0, 0}, 2);
    const double little = *gmsd(pictures, mask);
    cv::GaussianBlur(pictures.photo_luma, pictures.render_luma, {0, 0}, 5);
    EXPECT_GT(little, 0.001);
    EXPECT_GT(*gmsd(pictures, mask), little);
    cv::Mat three = cv::Mat::zeros(mask.size(), CV_8U);
    three(cv::Rect(40, 40, 3, 1)).setTo(255);
    EXPECT_FALSE(gmsd(pictures, three).has_value());
}

// All of one colour: the distance is that of the two colours, wherever the pixels lie. Lightness of
// 0.18 and 0.5 by the CIE formula: 116 cbrt(Y) - 16.
TEST(ColourDistributions, OfFlatPicturesHaveAClosedForm) {
    const cv::Mat dark(20, 20, CV_32FC3, cv::Scalar(0.18, 0.18, 0.18)),
        light(20, 20, CV_32FC3, cv::Scalar(0.5, 0.5, 0.5));
    const ColourDistributions result = colour_distributions(linear_pair(dark, light));
    EXPECT_NEAR(result.emd, 116 * (std::cbrt(0.5) - std::cbrt(0.18)), 0.01);
    EXPECT_NEAR(result.photo_light, 0.18, 1e-6);
    EXPECT_NEAR(result.render_light, 0.5, 1e-6);
}

TEST(ColourDistributions, DoNotSeeWhereColoursAre) {
    const cv::Mat photo = decoded(bytes_by_formula(false));
    cv::Mat mirrored;
    cv::flip(photo, mirrored, -1);
    const ColourDistributions result = colour_distributions(linear_pair(photo, mirrored));
    EXPECT_NEAR(result.emd, 0, 1e-4);
    EXPECT_NEAR(result.body_difference, 0, 1e-6);
}

TEST(Reflexes, AgreeInHueOrNot) {
    const auto with = [](const cv::Scalar& left, const cv::Scalar& right) {
        cv::Mat picture(200, 200, CV_32FC3, cv::Scalar(0.03, 0.03, 0.03));
        cv::circle(picture, {60, 100}, 5, left, cv::FILLED);
        cv::circle(picture, {140, 100}, 5, right, cv::FILLED);
        return picture;
    };
    const cv::Scalar red(0.9, 0.3, 0.3), blue(0.3, 0.4, 0.9), white(0.9, 0.9, 0.9);
    const auto hues = [&](const cv::Mat& photo, const cv::Mat& render) {
        return match_reflexes(linear_pair(photo, render));
    };
    EXPECT_EQ(*hues(with(red, blue), with(red, blue))->hue_agreement, 1);
    EXPECT_EQ(*hues(with(red, blue), with(red, red))->hue_agreement, 0.5);
    // A render without dispersion: white where the photo is coloured.
    EXPECT_EQ(*hues(with(red, blue), with(white, white))->hue_agreement, 0);
    EXPECT_FALSE(hues(with(white, white), with(red, blue))->hue_agreement.has_value());
    EXPECT_EQ(hues(with(red, white), with(red, white))->coloured, 1);
}

}  // namespace
}  // namespace culet
