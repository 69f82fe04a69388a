#pragma once
// How the camera turned around the ball between two pictures, found from what both show.

#include <string>

#include "compare/light_probe/ball_view.h"

namespace culet {

/// What is known of a view before the two are brought together.
struct ViewPrior {
    BallCircle circle;
    double circle_sigma_px = 0;  ///< of the centre and the radius; 0: exact
    PixelPlace principal;
    double focal_px = 0;  ///< 0: not known; then the distance is
    double distance = 0;  ///< in ball radii, may be infinite; 0: not known, found here
};

/// A view from its prior; an unknown distance is taken as `otherwise`.
MirrorBall ball_of(const ViewPrior& prior, double otherwise);

struct ViewAlignment {
    glm::dmat3 first_from_second{1.0};  ///< directions in camera frames
    double correlation = 0;             ///< of log-luminance where both views are good, -1..1
    double rival = 0;                   ///< correlation of the best quite different rotation
    double gain = 1;                    ///< first over second: their exposures differ by so much
    double residual = 0;                ///< median disagreement, stops
    double sigma = 0;                   ///< of the rotation, radians (one standard deviation)
    MirrorBall first, second;           ///< with outlines and distance refined by the agreement
    /// No rotation stands out: the light has too little structure, or the views are not of one
    /// room.
    bool ambiguous = false;
};

/// A rotation right to a fraction of a degree, by what two pictures show.
struct RoughTurn {
    glm::dmat3 first_from_second{1.0};
    double correlation = 1;  ///< of low-passed log-luminance
    double rival = -1;       ///< of the best quite different rotation
    /// Beside chance: a rotation that is far off must be clearly worse, and the best must be good.
    bool ambiguous() const { return correlation < 0.5 || rival > correlation - 0.05; }
};

/// Best over all rotations: correlation of what both show, coarse over SO(3) (quaternions of Alexa
/// 2022, eq. 6: super-Fibonacci spirals), with the balls where the views say. Deterministic.
RoughTurn rough_turn(const BallView& first, const BallView& second);

/// The last fraction of a degree, from a rotation right to a few degrees, by least squares
/// (view_solver.h). First both pictures are compared direction by direction, from coarse to fine.
/// Then each picture is predicted from a map made of the other alone, sharpened (light_merge.h),
/// through its own pixels: the two views' different blur, which in dark beside bright looks like a
/// shift, is then on both sides of the comparison. Outlines that have to be moved farther than
/// their sigmas allow are given larger ones. Four such solutions from pixels of their own are
/// averaged; sigma is their scatter and that which each finds by itself, for the errors of neither
/// average out: over 20 random rooms the rotation's error was 0.85 (60 pixels) and 0.97 (110
/// pixels) of it. Free are the rotation, the outlines within their sigmas, the gain, and the
/// distance where no prior knows it. Deterministic.
ViewAlignment align_views(const BallView& first, const ViewPrior& first_prior,
                          const BallView& second, const ViewPrior& second_prior,
                          const RoughTurn& rough);

}  // namespace culet
