#pragma once
// A photograph and a render, aligned once, as pictures that can be scored: mask, white level, gain.

#include <array>

#include "compare/registration/frame.h"
#include "compare/scores/metrics.h"

namespace culet {

struct AlignedPair {
    Frame frame;
    double photo_saturation = 0, render_saturation = 0;  ///< where they clip; 0: they do not
    MatchedPictures pictures;                            ///< the gain is on the render
    cv::Mat usable;  ///< CV_8U: compared, and clipped in neither picture
    std::array<double, 3> gain{1, 1, 1};
    double saturated = 0;  ///< share of compared pixels that the photo's camera clipped
    int compared_pixels = 0;

    bool enough() const { return compared_pixels >= k_least_pixels; }
    /// The outlines fit, and there is something to compare.
    bool comparable() const { return frame.match.usable && enough(); }
    /// Fewer pixels than this hold no pattern: a stone of 32 pixels has some 700.
    static constexpr int k_least_pixels = 400;
};

/// Aligns by the outlines, then compares what lies inside both by two pixels, or by half a per cent
/// of a large stone: there the outlines' error lives; and what the photo does not ignore.
/// With too few pixels no gain is solved. The one way from a photograph and a render to pictures of
/// one raster: `photo` with its mask and what is left out, `largest` as for `align`.
AlignedPair aligned(const Photo& photo, const Photo& render, double largest = 640);

/// The pair with another picture in the render's place, of the same size and outline: as a lens
/// would show it, say. Its place is the same; the gain is solved anew.
AlignedPair with_render(AlignedPair pair, const Photo& render);

/// Of the frame, what the scores need: the mask's box and as much around it as they look beyond.
cv::Rect part_to_score(const MatchedPictures& pictures);

/// A copy of a part of the pictures.
MatchedPictures part_of(const MatchedPictures& pictures, const cv::Rect& part);

/// The white level of a stone's picture: where its camera clips, else its 99.5 % quantile (`mask`
/// as for `quantile`).
double white_level(const cv::Mat& colour, const cv::Mat& mask, double saturation);

/// 255 where the picture is not clipped, under the mask.
cv::Mat not_clipped(const cv::Mat& colour, double saturation, const cv::Mat& mask);

void multiply_channels(cv::Mat& colour, const std::array<double, 3>& gain);

}  // namespace culet
