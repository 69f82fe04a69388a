#pragma once
// The null of a score: the same score for the render rotated and mirrored in its plane.

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "compare/scores/metrics.h"

namespace culet {

/// A 2 x 3 matrix from rotated positions to the render's.
struct Rotation {
    cv::Matx23d render_from_rotated;
};

/// Random rotations about the middle of `outline`, every second one mirrored. For a stone that is
/// not round, rotations in the frame where its ellipse of inertia is a circle, so that it covers
/// the same area. A draw that hardly changes the render (correlation over `k_same_render`: a
/// symmetric stone under symmetric light) is drawn again; there may be fewer than `count` others.
/// One seed gives the same on every machine.
std::vector<Rotation> draw_rotations(const MatchedPictures& pictures, const cv::Mat& outline,
                                     int count, std::uint64_t seed);

constexpr double k_same_render = 0.9;

/// The mask is the overlap of both outlines.
MatchedPictures rotated(const MatchedPictures& pictures, const Rotation& draw);

}  // namespace culet
