#include "compare/scores/metrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/quality/qualityssim.hpp>
#include <set>

#include "compare/photo/pixels.h"
#include "compare/photo/resampling.h"
#include "compare/scores/aligned_pair.h"
#include "compare/scores/flip.h"
#include "compare/scores/reflexes.h"
#include "compare/scores/score_list.h"
#include "compare/scores/wavelet_similarity.h"

namespace culet {
namespace {

cv::Mat noise(int size, std::uint64_t seed, double blur = 1.5) {
    cv::RNG random(seed);
    cv::Mat picture(size, size, CV_32FC3);
    random.fill(picture, cv::RNG::UNIFORM, 0.0, 1.0);
    cv::GaussianBlur(picture, picture, {0, 0}, blur);
    return picture;
}

MatchedPictures pair_of(const cv::Mat& photo, const cv::Mat& render) {
    MatchedPictures pictures;
    pictures.photo = photo;
    pictures.render = render;
    pictures.mask = cv::Mat(photo.size(), CV_8U, cv::Scalar(255));
    pictures.diameter = photo.cols;
    return pictures;
}

cv::Mat flat(double r, double g, double b, int size = 48) {
    return cv::Mat(size, size, CV_32FC3, cv::Scalar(r, g, b));
}

// An independent implementation: OpenCV's, which takes 8-bit pictures (its constants are wrong for
// floats). The two may differ only by rounding to 8 bits.
TEST(Ssim, AgreesWithOpencvOn8Bits) {
    const cv::Mat photo = noise(96, 1), render = 0.7 * photo + 0.3 * noise(96, 2);
    cv::Mat photo_bytes, render_bytes;
    ShownPictures pictures = shown(pair_of(photo, render));
    pictures.photo_luma.convertTo(photo_bytes, CV_8U, 255);
    pictures.render_luma.convertTo(render_bytes, CV_8U, 255);
    photo_bytes.convertTo(pictures.photo_luma, CV_32F, 1 / 255.0);
    render_bytes.convertTo(pictures.render_luma, CV_32F, 1 / 255.0);
    cv::Mat map;
    cv::quality::QualitySSIM::compute(photo_bytes, render_bytes, map);
    const ScoreMap ours = ssim(pictures, cv::Mat(photo.size(), CV_8U, cv::Scalar(255)));
    // Away from the border, which the two extrapolate differently.
    const cv::Rect middle(8, 8, 80, 80);
    EXPECT_LT(cv::norm(ours.map(middle), map(middle), cv::NORM_INF), 2e-3);
}

// A pitfall of SSIM's constants: on 0..1 floats without scaling this would be near 0.99.
TEST(Ssim, ACopyAtHalfBrightnessIsFarFromPerfect) {
    const cv::Mat photo = noise(96, 1);
    const cv::Mat half = 0.25 * photo;
    const MatchedPictures pictures = pair_of(photo, half);
    EXPECT_LT(ssim(shown(pictures), pictures.mask).mean, 0.9);
    EXPECT_NEAR(*zncc(pictures, 0.02), 1, 1e-6);
}

TEST(Ssim, BoundsAndSymmetry) {
    const cv::Mat photo = noise(64, 1), render = noise(64, 2);
    const MatchedPictures ab = pair_of(photo, render), ba = pair_of(render, photo);
    EXPECT_NEAR(ssim(shown(ab), ab.mask).mean, ssim(shown(ba), ba.mask).mean, 1e-6);
    EXPECT_NEAR(*zncc(ab, 0.02), *zncc(ba, 0.02), 1e-9);
    EXPECT_NEAR(*psnr(shown(ab), ab.mask), *psnr(shown(ba), ba.mask), 1e-9);
    EXPECT_LE(std::abs(*zncc(ab, 0.02)), 1);
}

// An error of 0.1 of full scale everywhere is 20 dB by definition.
TEST(Psnr, OfAKnownError) {
    ShownPictures pictures;
    pictures.photo = cv::Mat(8, 8, CV_32FC3, cv::Scalar(0.5, 0.5, 0.5));
    pictures.render = cv::Mat(8, 8, CV_32FC3, cv::Scalar(0.6, 0.6, 0.6));
    const cv::Mat mask(8, 8, CV_8U, cv::Scalar(255));
    EXPECT_NEAR(*psnr(pictures, mask), 20, 1e-5);
    pictures.render = pictures.photo;
    EXPECT_FALSE(psnr(pictures, mask).has_value());
}

TEST(Zncc, OfANegativeIsMinusOneAndOfFlatIsNothing) {
    cv::Mat photo = noise(64, 3), negative;
    // The root of the negative is 1 - root of the positive.
    cv::Mat root;
    cv::sqrt(luminance(photo), root);
    cv::Mat opposite = 1 - root;
    cv::multiply(opposite, opposite, opposite);
    cv::Mat channels[] = {opposite, opposite, opposite};
    cv::merge(channels, 3, negative);
    EXPECT_NEAR(*zncc(pair_of(photo, negative), 0.02), -1, 1e-4);
    EXPECT_FALSE(zncc(pair_of(photo, flat(0.3, 0.3, 0.3, 64)), 0.02).has_value());
}

TEST(Zncc, SeesNothingOutsideTheMask) {
    const cv::Mat photo = noise(64, 4);
    cv::Mat render = photo.clone();
    MatchedPictures pictures = pair_of(photo, render);
    pictures.mask.setTo(0);
    pictures.mask(cv::Rect(10, 10, 40, 40)).setTo(255);
    cv::Mat spoiled = render.clone();
    spoiled.rowRange(0, 10).setTo(cv::Scalar(1, 1, 1));
    spoiled.rowRange(50, 64).setTo(cv::Scalar(0, 0, 0));
    pictures.render = spoiled;
    EXPECT_NEAR(*zncc(pictures, 0.04), 1, 1e-6);
    EXPECT_FALSE(psnr(shown(pictures), pictures.mask).has_value());
    EXPECT_EQ(deltaE00(pictures).mean, 0);
    EXPECT_EQ(flip(pictures).mean, 0);
}

TEST(Gain, IsExactForAScaledCopyAndRobustToReflexes) {
    const cv::Mat render = noise(64, 5);
    cv::Mat photo = render.clone();
    cv::multiply(photo, cv::Scalar(0.5, 2, 1), photo);
    const cv::Mat mask(photo.size(), CV_8U, cv::Scalar(255));
    EXPECT_NEAR(solve_gain(photo, render, mask)[0], 0.5, 1e-7);
    EXPECT_NEAR(solve_gain(photo, render, mask)[1], 2, 1e-6);
    // A fiftieth of the picture is a reflection that the render lacks.
    photo(cv::Rect(5, 5, 9, 9)).setTo(cv::Scalar(40, 40, 40));
    EXPECT_NEAR(solve_gain(photo, render, mask)[0], 0.5, 0.01);
    const auto dark = solve_gain(photo, cv::Mat::zeros(photo.size(), CV_32FC3), mask);
    EXPECT_EQ(dark[0], 1);
}

// Andersson et al. (2020): 0 for equal pictures; green against blue is the largest difference, 1;
// black against white is 0.967 by equations 4 to 6 (HyAB 100).
TEST(Flip, HasThePublishedEndsOfItsScale) {
    const auto at_middle = [](const cv::Mat& a, const cv::Mat& b) {
        return flip_map(a, b).at<float>(a.rows / 2, a.cols / 2);
    };
    EXPECT_EQ(at_middle(flat(0.2, 0.4, 0.1), flat(0.2, 0.4, 0.1)), 0);
    EXPECT_NEAR(at_middle(flat(0, 1, 0), flat(0, 0, 1)), 1.000, 1e-3);
    EXPECT_NEAR(at_middle(flat(0, 0, 0), flat(1, 1, 1)), 0.967, 1e-3);
}

TEST(Flip, IsSymmetricAndWithin0And1) {
    const cv::Mat a = noise(64, 6), b = noise(64, 7);
    const cv::Mat ab = flip_map(a, b), ba = flip_map(b, a);
    EXPECT_LT(cv::norm(ab, ba, cv::NORM_INF), 1e-5);
    double low = 0, high = 0;
    cv::minMaxLoc(ab, &low, &high);
    EXPECT_GE(low, 0);
    EXPECT_LE(high, 1);
}

TEST(CwSsim, IsOneForEqualPicturesAndForgivesASmallShift) {
    const cv::Mat photo = noise(160, 8, 3), other = noise(160, 9, 3);
    const MatchedPictures same = pair_of(photo, photo), wrong = pair_of(photo, other);
    const cv::Mat moved =
        resampled(photo, {1, 0, 0.7, 0, 1, 0}, photo.size(), Kernel::cubic, Beyond::nearest);
    const MatchedPictures shifted = pair_of(photo, moved);
    const auto value = [](const MatchedPictures& p) {
        return cw_ssim(shown(p), p.mask, wavelet_bank(p.mask.size(), p.diameter));
    };
    EXPECT_NEAR(value(same), 1, 1e-5);
    EXPECT_GT(value(shifted), 0.95);
    EXPECT_LT(value(wrong), 0.75);
}

// CW-SSIM by its definition: every wavelet's response at every pixel.
double cw_ssim_everywhere(const MatchedPictures& pictures) {
    const ShownPictures pair = shown(pictures);
    const auto spectrum_of = [&](const cv::Mat& luma) {
        cv::Mat inside = cv::Mat::zeros(luma.size(), CV_32F), spectrum;
        const cv::Mat centred = luma - cv::mean(luma, pictures.mask)[0];
        centred.copyTo(inside, pictures.mask);
        cv::dft(inside, spectrum, cv::DFT_COMPLEX_OUTPUT);
        return spectrum;
    };
    const cv::Mat a = spectrum_of(pair.photo_luma), b = spectrum_of(pair.render_luma);
    double sum = 0;
    for (const double part : {0.03, 0.06}) {
        const double wavelength = std::max(4.0, part * pictures.diameter);
        for (int k = 0; k < 6; ++k) {
            const auto answer = [&](const cv::Mat& spectrum) {
                cv::Mat filtered = spectrum.clone(), space;
                for (int y = 0; y < spectrum.rows; ++y) {
                    for (int x = 0; x < spectrum.cols; ++x) {
                        const auto cycles = [](int i, int n) {
                            return static_cast<double>(i <= n / 2 ? i : i - n) / n;
                        };
                        const double u = cycles(x, spectrum.cols), v = cycles(y, spectrum.rows);
                        const double octaves =
                            std::log(std::max(1e-9, std::hypot(u, v)) * wavelength) /
                            std::log(0.65);
                        const double off = std::remainder(
                            std::atan2(v, u) - k * std::numbers::pi / 6, 2 * std::numbers::pi);
                        const double directions = off / (std::numbers::pi / 6);
                        filtered.at<cv::Vec2f>(y, x) *= static_cast<float>(
                            std::exp(-0.5 * (octaves * octaves + directions * directions)));
                    }
                }
                cv::dft(filtered, space, cv::DFT_INVERSE | cv::DFT_SCALE);
                return space;
            };
            const cv::Mat p = answer(a), q = answer(b);
            cv::Mat product, left, right, parts[2], real, imaginary, energy;
            cv::mulSpectrums(p, q, product, 0, true);
            cv::mulSpectrums(p, p, left, 0, true);
            cv::mulSpectrums(q, q, right, 0, true);
            cv::split(product, parts);
            const auto windowed = [&](const cv::Mat& plane) {
                cv::Mat mean;
                cv::GaussianBlur(plane, mean, {0, 0}, wavelength / 2, wavelength / 2,
                                 cv::BORDER_REPLICATE);
                return mean;
            };
            real = windowed(parts[0]);
            imaginary = windowed(parts[1]);
            cv::extractChannel(left + right, energy, 0);
            energy = windowed(energy);
            cv::Mat common;
            cv::magnitude(real, imaginary, common);
            const cv::Mat ratio = (2 * common + 1e-6) / (energy + 1e-6);
            sum += cv::mean(ratio, pictures.mask)[0];
        }
    }
    return sum / 12;
}

TEST(CwSsim, AtFewPlacesIsThatAtEveryPixel) {
    for (const int other : {8, 9, 11}) {
        MatchedPictures pictures = pair_of(noise(160, 8, 3), noise(160, other, 3));
        if (other == 11)
            pictures.render = resampled(pictures.photo, {0.99, 0.02, 1, -0.02, 0.99, 2},
                                        pictures.photo.size(), Kernel::cubic, Beyond::nearest);
        pictures.mask.setTo(0);
        cv::circle(pictures.mask, {80, 80}, 60, cv::Scalar(255), cv::FILLED);
        pictures.diameter = 120;
        const double value = cw_ssim(shown(pictures), pictures.mask,
                                     wavelet_bank(pictures.mask.size(), pictures.diameter));
        // The possible effect of a hundredth of a wavelet's weight at the ends of its band.
        EXPECT_NEAR(value, cw_ssim_everywhere(pictures), 0.005) << other;
    }
}

// Scores use the stone alone, so a part of the frame that contains it is enough. Wavelets wrap
// round at the ends of the frame, which are closer in a part.
TEST(ScoredPart, OfTheFrameGivesTheWholeFramesScores) {
    MatchedPictures whole = pair_of(noise(200, 12, 2), noise(200, 13, 2));
    whole.render = 0.5 * whole.photo + 0.5 * whole.render;
    whole.mask.setTo(0);
    cv::ellipse(whole.mask, {111, 87}, {60, 45}, 20, 0, 360, cv::Scalar(255), cv::FILLED);
    whole.diameter = 104;
    const cv::Rect box = part_to_score(whole);
    EXPECT_EQ(box.x % 2, 0);
    EXPECT_EQ(box.y % 2, 0);
    EXPECT_LT(box.area(), 0.7 * whole.mask.cols * whole.mask.rows);
    const MatchedPictures part = part_of(whole, box);
    const auto scores = [](const MatchedPictures& pictures) {
        const WaveletBank wavelets = wavelet_bank(pictures.mask.size(), pictures.diameter);
        return scores_of(measures_of(pictures, wavelets));
    };
    const std::vector<Score> of_whole = scores(whole), of_part = scores(part);
    ASSERT_EQ(of_part.size(), of_whole.size());
    for (std::size_t k = 0; k < of_part.size(); ++k) {
        const Score &a = of_whole[k], &b = of_part[k];
        ASSERT_EQ(a.value.has_value(), b.value.has_value()) << a.key;
        if (!a.value) continue;
        EXPECT_NEAR(*a.value, *b.value, a.key == "cw_ssim" ? 0.005 : 1e-5) << a.key;
    }
}

// Keys are names in the JSON, and a perfect score transforms to more than any other.
TEST(ScoreTable, HasEachKeyOnceAndSaysWhichWayIsBetter) {
    std::set<std::string> keys;
    for (const ScoreKind& kind : score_kinds()) {
        EXPECT_TRUE(keys.insert(kind.key).second) << kind.key;
        EXPECT_EQ(score_kind(kind.key), &kind);
        const double good = kind.higher_is_better() ? 0.9 : 0.1;
        EXPECT_GE(stabilised(good, kind.scale), stabilised(1 - good, kind.scale)) << kind.key;
    }
    EXPECT_EQ(score_kind("none"), nullptr);
}

TEST(ScoredPart, EndsWhereTheFrameDoes) {
    const MatchedPictures pictures = pair_of(noise(64, 1), noise(64, 2));
    EXPECT_EQ(part_to_score(pictures), cv::Rect(0, 0, 64, 64));
}

cv::Mat spots(const std::vector<cv::Point>& middles, int radius = 3) {
    cv::Mat picture = flat(0.05, 0.05, 0.05, 200);
    for (const cv::Point& p : middles) {
        cv::circle(picture, p, radius, cv::Scalar(0.9, 0.9, 0.9), cv::FILLED);
    }
    return picture;
}

// Four spots of 200 pixels. The render has the first two, one of them 2 pixels (1 % of the
// diameter) away; the third 10 pixels away (too far); and one of its own.
TEST(Reflexes, AreCountedAndMatched) {
    const auto match = match_reflexes(pair_of(spots({{40, 40}, {150, 40}, {40, 150}, {150, 150}}),
                                              spots({{40, 40}, {152, 40}, {50, 150}, {100, 100}})));
    ASSERT_TRUE(match.has_value());
    EXPECT_EQ(match->in_photo, 4);
    EXPECT_EQ(match->in_render, 4);
    EXPECT_EQ(match->matched, 2);
    EXPECT_NEAR(match->f1, 0.5, 1e-12);
    EXPECT_NEAR(match->area_f1, 0.5, 1e-12);
    EXPECT_NEAR(*match->displacement, 0.01, 1e-9);
}

TEST(Reflexes, OfAnotherSizeDoNotMatch) {
    const auto match = match_reflexes(pair_of(spots({{100, 100}}), spots({{100, 100}}, 9)));
    EXPECT_EQ(match->matched, 0);
    EXPECT_FALSE(match->displacement.has_value());
}

TEST(Reflexes, OfAFlatPhotoAreNone) {
    EXPECT_FALSE(match_reflexes(pair_of(flat(0.2, 0.2, 0.2),
                                        spots({{20, 20}})(cv::Rect(0, 0, 48, 48)).clone()))
                     .has_value());
}

TEST(Resampling, AShiftByWholePixelsMovesSamplesUnchanged) {
    const cv::Mat picture = noise(32, 10);
    for (const Kernel kernel : {Kernel::linear, Kernel::cubic}) {
        const cv::Mat moved =
            resampled(picture, {1, 0, 3, 0, 1, -2}, picture.size(), kernel, Beyond::nearest);
        EXPECT_EQ(moved.at<cv::Vec3f>(10, 10), picture.at<cv::Vec3f>(8, 13));
    }
}

// Both kernels reproduce a linear ramp exactly (their order is at least one).
TEST(Resampling, ReproducesARamp) {
    cv::Mat ramp(32, 32, CV_32F);
    for (int y = 0; y < 32; ++y) {
        for (int x = 0; x < 32; ++x) ramp.at<float>(y, x) = static_cast<float>(3 * x + 2 * y + 5);
    }
    const cv::Matx23d turn(0.96, -0.28, 6, 0.28, 0.96, 1);
    for (const Kernel kernel : {Kernel::linear, Kernel::cubic}) {
        const cv::Mat turned = resampled(ramp, turn, {32, 32}, kernel, Beyond::nothing);
        const cv::Vec2d at = turn * cv::Vec3d(14, 12, 1);
        EXPECT_NEAR(turned.at<float>(12, 14), 3 * at[0] + 2 * at[1] + 5, 1e-4);
    }
}

TEST(Resampling, FarOutsideIsNothingOrTheBorder) {
    const cv::Mat picture(4, 4, CV_32F, cv::Scalar(2));
    const cv::Matx23d away(1, 0, 1e12, 0, 1, -1e12);
    EXPECT_EQ(cv::countNonZero(resampled(picture, away, {4, 4}, Kernel::cubic, Beyond::nothing)),
              0);
    EXPECT_NEAR(resampled(picture, away, {4, 4}, Kernel::cubic, Beyond::nearest).at<float>(1, 1), 2,
                1e-6);
}

}  // namespace
}  // namespace culet
