#pragma once
// Finds the camera's rotation around the ball between two pictures.

#include <string>

#include "compare/light_probe/ball_view.h"

namespace culet {

/// What is known of a view before the alignment.
struct ViewPrior {
    BallCircle circle;
    double circle_sigma_px = 0;  ///< of the centre and the radius; 0: exact
    PixelPlace principal;
    double focal_px = 0;  ///< 0: unknown; then the distance is known
    double distance = 0;  ///< in ball radii, may be infinite; 0: unknown, found here
};

/// A view from its prior; `otherwise` replaces an unknown distance.
MirrorBall ball_of(const ViewPrior& prior, double otherwise);

struct ViewAlignment {
    glm::dmat3 first_from_second{1.0};  ///< directions in camera frames
    double correlation = 0;             ///< of log-luminance where both views are good, -1..1
    double rival = 0;                   ///< correlation of the best clearly different rotation
    double gain = 1;                    ///< ratio of exposures, first over second
    double residual = 0;                ///< median disagreement, stops
    double sigma = 0;                   ///< of the rotation, radians
    MirrorBall first, second;           ///< with refined outlines and distance
    /// No rotation stands out: the light has little structure, or the rooms differ.
    bool ambiguous = false;
};

/// A rotation right to a fraction of a degree.
struct RoughTurn {
    glm::dmat3 first_from_second{1.0};
    double correlation = 1;  ///< of low-passed log-luminance
    double rival = -1;       ///< of the best clearly different rotation
    /// The best must be good, and clearly better than a different one.
    bool ambiguous() const { return correlation < 0.5 || rival > correlation - 0.05; }
};

/// The best of all rotations by correlation, on a coarse grid over SO(3) (quaternions of Alexa
/// 2022, eq. 6: super-Fibonacci spirals). The balls' geometry is the views'. Deterministic.
RoughTurn rough_turn(const BallView& first, const BallView& second);

/// Refines a rotation from a few degrees to the final accuracy by least squares (view_solver.h).
/// Free are the rotation, the outlines within their sigmas, the gain, and the distance if no prior
/// knows it. Deterministic.
///
/// First compares both pictures direction by direction, coarse to fine. Then predicts each picture,
/// through its own pixels, from a sharpened map of the other (light_merge.h), so that both have the
/// same blur; different blur of dark beside bright looks like a shift. Outlines that must move too
/// far for their sigmas get larger ones.
///
/// Averages four such solutions from separate pixels. Sigma combines their scatter and their own
/// sigmas, because neither error averages out: over 20 random rooms the rotation's error was 0.85
/// (60 pixels) and 0.97 (110 pixels) of it.
ViewAlignment align_views(const BallView& first, const ViewPrior& first_prior,
                          const BallView& second, const ViewPrior& second_prior,
                          const RoughTurn& rough);

}  // namespace culet
