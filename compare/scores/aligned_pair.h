#pragma once
// A photograph and a render, aligned once and ready to be scored: mask, white level, gain.

#include <array>

#include "compare/registration/frame.h"
#include "compare/scores/metrics.h"

namespace culet {

struct AlignedPair {
    Frame frame;
    double photo_saturation = 0, render_saturation = 0;  ///< where they clip; 0: nowhere
    MatchedPictures pictures;                            ///< with the gain on the render
    cv::Mat usable;  ///< CV_8U: compared, and clipped in neither picture
    std::array<double, 3> gain{1, 1, 1};
    double saturated = 0;  ///< share of compared pixels that the photo's camera clipped
    int compared_pixels = 0;

    bool enough() const { return compared_pixels >= k_least_pixels; }
    /// The outlines fit, and enough pixels are left.
    bool comparable() const { return frame.match.usable && enough(); }
    /// Fewer pixels hold no pattern: a stone of 32 pixels has some 700.
    static constexpr int k_least_pixels = 400;
};

/// Aligns `photo` and `render` by their outlines; the only way to compared pictures of one raster.
/// Compares pixels that are not ignored and lie inside both outlines by two pixels, or 0.5 % of a
/// large stone, clear of the outlines' errors. With too few pixels no gain is solved. `largest`: as
/// for `align`.
AlignedPair aligned(const Photo& photo, const Photo& render, double largest = 640);

/// Replaces the render by another picture of the same size and outline, such as a blurred one.
/// Keeps the registration and solves the gain anew.
AlignedPair with_render(AlignedPair pair, const Photo& render);

/// The mask's box plus the scores' margin.
cv::Rect part_to_score(const MatchedPictures& pictures);

MatchedPictures part_of(const MatchedPictures& pictures, const cv::Rect& part);

/// Where the stone's camera clips, otherwise the 99.5 % quantile (`mask` as for `quantile`).
double white_level(const cv::Mat& colour, const cv::Mat& mask, double saturation);

/// 255 where not clipped, under the mask.
cv::Mat not_clipped(const cv::Mat& colour, double saturation, const cv::Mat& mask);

void multiply_channels(cv::Mat& colour, const std::array<double, 3>& gain);

}  // namespace culet
