#pragma once
// From a registered frame to pictures that can be scored: mask, white level and gain.

#include <array>

#include "compare/registration/frame.h"
#include "compare/scores/metrics.h"

namespace culet {

struct LaidPictures {
    MatchedPictures pictures;  ///< the gain is on the render
    cv::Mat usable;            ///< CV_8U: compared, and clipped in neither picture
    std::array<double, 3> gain{1, 1, 1};
    double saturated = 0;  ///< share of compared pixels that the photo's camera clipped
    int compared_pixels = 0;
    bool enough() const { return compared_pixels >= k_least_pixels; }
    /// Fewer pixels than this hold no pattern: a stone of 32 pixels has some 700.
    static constexpr int k_least_pixels = 400;
};

/// Compares what lies inside both outlines by two pixels, or by half a per cent of a large stone:
/// there the outlines' error lives; and what the photo's frame does not say to leave out. A
/// saturation of 0: that picture does not clip. With too few pixels no gain is solved.
LaidPictures lay_pictures(const Frame& frame, double photo_saturation, double render_saturation);

/// Of the frame, what the scores need: the mask's box and as much around it as they look beyond.
cv::Rect part_to_score(const MatchedPictures& pictures);

/// A copy of a part of the pictures.
MatchedPictures part_of(const MatchedPictures& pictures, const cv::Rect& part);

/// The white level of a stone's picture: where its camera clips, else its 99.5 % quantile.
double white_level(const cv::Mat& colour, const cv::Mat& mask, double saturation);

/// 255 where the picture is not clipped, under the mask.
cv::Mat not_clipped(const cv::Mat& colour, double saturation, const cv::Mat& mask);

void multiply_channels(cv::Mat& colour, const std::array<double, 3>& gain);

}  // namespace culet
