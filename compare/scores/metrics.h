#pragma once
// Scores of two registered pictures. Each uses only pixels under the mask.

#include <array>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

namespace culet {

/// Photo and render in one frame. Colours are linear, CV_32FC3, R G B.
struct MatchedPictures {
    cv::Mat photo, render;
    cv::Mat mask;         ///< CV_8U: inside both outlines, by a margin
    double diameter = 0;  ///< of the stone, pixels
    double white = 1;     ///< linear value shown as white; both are clipped there
};

/// Factor for each channel of the render: exposure and white balance. Least squares in linear light
/// through zero, with Huber weights (1964) against single reflexes. `usable`: pixels that are not
/// saturated. 1 for a channel in which either picture is black. Misplaced reflexes pull it towards
/// 0, so it is a photometric measurement only if the pictures match.
std::array<double, 3> solve_gain(const cv::Mat& photo, const cv::Mat& render,
                                 const cv::Mat& usable);

/// Encoded (sRGB, clipped at white) once for all scores.
struct ShownPictures {
    cv::Mat photo, render;            ///< CV_32FC3, 0..1
    cv::Mat photo_luma, render_luma;  ///< CV_32F, 0..1: encoded luminance
};
ShownPictures shown(const MatchedPictures& pictures);

/// Are the same places bright and dark? For each of `blurs`, the correlation of the square roots of
/// luminance, blurred inside the mask by a Gaussian of that many diameters. -1..1; independent of
/// the gain. Nothing when either picture is uniform.
std::vector<std::optional<double>> zncc(const MatchedPictures& pictures,
                                        const std::vector<double>& blurs);
std::optional<double> zncc(const MatchedPictures& pictures, double blur);

/// Structural similarity (Wang, Bovik, Sheikh, Simoncelli 2004) of encoded luminance on the scale
/// 0..255, Gaussian window of 1.5 pixels, K1 = 0.01, K2 = 0.03.
struct ScoreMap {
    double mean = 0;
    cv::Mat map;  ///< CV_32F, the frame's size
};
ScoreMap ssim(const ShownPictures& pictures, const cv::Mat& mask);

/// Peak signal-to-noise ratio of encoded colours, decibel, peak 1. Nothing for equal pictures.
std::optional<double> psnr(const ShownPictures& pictures, const cv::Mat& mask);

struct ColourScore {
    double mean = 0, percentile_95 = 0;
    cv::Mat map;  ///< CIEDE2000 of each pixel
};
ColourScore deltaE00(const MatchedPictures& pictures);

}  // namespace culet
