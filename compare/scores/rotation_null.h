#pragma once
// What a score is worth: the same score for the same render, rotated and mirrored in its plane.

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "compare/scores/metrics.h"

namespace culet {

/// A 2 x 3 matrix from rotated positions to the render's.
struct Rotation {
    cv::Matx23d render_from_rotated;
};

/// Random rotations by any angle, every second one mirrored, about the middle of `outline`. For a
/// stone that is not round the rotation is taken in the frame in which its ellipse of inertia is a
/// circle, so that the rotated stone covers the same ground. A draw that leaves the render much as
/// it was (correlation over `k_same_render`: a symmetric stone under symmetric light) would be no
/// null at all and is drawn again; fewer than `count` draws come back when there are too few
/// others. Repeatable for one seed on every machine.
std::vector<Rotation> draw_rotations(const MatchedPictures& pictures, const cv::Mat& outline,
                                     int count, std::uint64_t seed);

constexpr double k_same_render = 0.9;

/// The pictures with the render rotated; the mask is what both outlines cover.
MatchedPictures rotated(const MatchedPictures& pictures, const Rotation& draw);

}  // namespace culet
