#pragma once
// Finds the mirror ball in a photograph.

#include <optional>
#include <vector>

#include "compare/light_probe/mirror_ball.h"
#include "compare/photo/photo.h"

namespace culet {

struct FoundBall {
    BallCircle circle;
    double support = 0;  ///< 0..1: share of the outline where there is an edge
    /// Of a mirror ball: support * (compression - 1) * (1 - alike) of the rim (rim_compression.h).
    double evidence = 0;
    double sigma_px = 0;  ///< standard uncertainty of centre and radius
    /// For the first ball: a circle elsewhere with nearly as much evidence.
    std::optional<BallCircle> rival = {};
};

/// Share of the ball's evidence.
inline constexpr double k_rival_evidence = 0.8;

/// The likeliest balls, by falling evidence: circles from Hough's transform at several scales and
/// thresholds, each fitted to a fraction of a pixel to the edges on rays from its middle (RANSAC
/// over three points, then iterated least squares with Tukey's weights). Of a ball cut off by the
/// picture's border only the visible part counts. Empty when none has `least_support`.
/// Deterministic.
std::vector<FoundBall> find_balls(const Photo& photo, double least_support = 0.45);

}  // namespace culet
