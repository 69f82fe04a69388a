#pragma once
// Brings the render's outline onto the photo's. Only outlines are used: reflexes inside the stone
// are what the comparison is about, and misplaced ones would drag the registration along.

#include <array>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "compare/registration/silhouette.h"

namespace culet {

/// q = scale * R(turn) * (p - about) + about + shift, from photo pixels p to render pixels q.
/// Positive `turn` takes +x towards +y: clockwise as seen, because y runs down.
/// A similarity, not an affinity: shift, turn and distance of a camera are free, but a stretch
/// would hide a stone of the wrong shape or a camera that looks from the wrong side.
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
    double worst_px = 0;           ///< 95 % of the outline is closer than this
    double iou = 0;                ///< area in both outlines over area in either
    bool turn_known = true;        ///< false: both outlines are round, and turn was left at 0
    bool usable = false;
    std::string trouble;  ///< why it is not usable, with a hint where one was found
};

/// Limits proposed in the field's practice rather than measured: an overlap of 0.9 is an outline
/// wrong by 2.5 % of the diameter all round, and reflexes are matched within 2 %.
struct OutlineLimits {
    double least_iou = 0.9;
    double most_residual = 0.02;  ///< of the diameter
    double most_turn = 0.7854;    ///< radians; a larger turn is named as a hint, never applied
};

/// Starts from the silhouettes' centres and areas, with turn 0 and, for stones that are not round,
/// with the turn of their long axes; then least squares (Ceres) on the distance of the photo's
/// outline points to the render's outline, with Huber's loss (1964) so that a holder or a chip does
/// not pull. Turning by quarters and mirroring are tried only to explain a failure.
OutlineMatch match_outlines(const Silhouette& photo, const Silhouette& render,
                            const OutlineLimits& limits = {});

}  // namespace culet
