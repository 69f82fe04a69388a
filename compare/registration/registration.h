#pragma once
// Registers the render's outline with the photo's. Internal reflexes are not used: they are what
// the comparison is about, and misplaced ones would bias it.

#include <array>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "compare/registration/silhouette.h"

namespace culet {

/// q = scale * R(turn) * (p - about) + about + shift, from photo pixels p to render pixels q.
/// Positive `turn` takes +x towards +y: clockwise as seen, because y runs down. Not an affinity,
/// because unequal scales would hide a wrong shape or viewing direction.
struct Similarity {
    double scale = 1, turn = 0;
    cv::Point2d about{0, 0}, shift{0, 0};
    cv::Point2d operator()(const cv::Point2d& p) const;
};

/// The 2 x 3 matrix of the same mapping.
cv::Matx23d matrix_of(const Similarity& similarity);

struct OutlineMatch {
    Similarity render_from_photo;  ///< `about` is the centre of the photo's silhouette
    double residual_px = 0;        ///< root mean square distance between the outlines, photo pixels
    double worst_px = 0;           ///< 95 % quantile of that distance
    double iou = 0;                ///< intersection over union of the outlines
    bool turn_known = true;        ///< false: both outlines are round, and turn stays 0
    bool usable = false;
    std::string trouble;  ///< why it is not usable, with a hint if one was found
};

/// Proposed from practice, not measured: an IoU of 0.9 is an outline wrong by 2.5 % of the diameter
/// all round, and reflexes are matched within 2 %.
struct OutlineLimits {
    double least_iou = 0.9;
    double most_residual = 0.02;  ///< share of the diameter
    double most_turn = 0.7854;    ///< radians; a larger turn is reported as a hint, never applied
};

/// Starts from the silhouettes' centres and areas with turn 0 and, for stones that are not round,
/// the turn of their long axes. Then least squares (Ceres) on the distances of the photo's outline
/// points to the render's outline, with Huber's loss (1964) against a holder or a chip. Quarter
/// turns and mirroring serve only to explain a failure.
OutlineMatch match_outlines(const Silhouette& photo, const Silhouette& render,
                            const OutlineLimits& limits = {});

}  // namespace culet
