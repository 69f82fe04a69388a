#pragma once
// Where the mirror ball is in a photograph.

#include <optional>
#include <vector>

#include "compare/light_probe/mirror_ball.h"
#include "compare/photo/photo.h"

namespace culet {

struct FoundBall {
    BallCircle circle;
    double support = 0;  ///< 0..1: share of the outline along which there is an edge
    /// How much speaks for a mirror ball: the support times what the compression at the rim
    /// (rim_compression.h) is over 1.
    double evidence = 0;
    double sigma_px = 0;  ///< of the centre and the radius, one standard deviation
    /// Of the first ball: another circle, elsewhere, with nearly as much evidence.
    std::optional<BallCircle> rival = {};
};

/// Evidence of a rival over that of the ball.
inline constexpr double k_rival_evidence = 0.8;

/// The likeliest balls, most evidence first: circles by Hough's transform at several scales and
/// thresholds, each fitted to the edges that rays from its middle meet (RANSAC over three points,
/// then iterated least squares with Tukey's weights, to a fraction of a pixel). Of a ball cut by
/// the picture's border only what is seen counts. Empty when there is none of `least_support`.
/// Deterministic.
std::vector<FoundBall> find_balls(const Photo& photo, double least_support = 0.45);

}  // namespace culet
