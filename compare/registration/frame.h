#pragma once
// Cuts the stone out of both pictures at one size and lays the render onto the photo.

#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "compare/photo/photo.h"
#include "compare/registration/registration.h"

namespace culet {

/// Where a picture shows its stone: under the painted mask, else by its coverage, else before the
/// background.
struct StoneSource {
    cv::Mat colour;             ///< CV_32FC3, linear: the photo's own pixels
    cv::Mat coverage;           ///< CV_32F; empty: the background tells
    std::string coverage_name;  ///< "mask" or "coverage"
};
StoneSource stone_source(const Photo& photo);
Silhouette silhouette_of(const StoneSource& source);

/// The part of a picture around its stone, perhaps reduced. A point p of the close-up lies at
/// (p + 0.5) / scale - 0.5 + corner in the picture.
struct CloseUp {
    cv::Mat colour;  ///< CV_32FC3, linear
    Silhouette silhouette;
    cv::Mat ignored;  ///< CV_8U, 255 where nothing is to be compared; empty: nowhere
    double scale = 1;
    cv::Point2d corner;
    cv::Point2d in_picture(const cv::Point2d& p) const;
};

/// What was cut out of a picture, and how much that was reduced.
struct Cut {
    cv::Rect box;
    double scale = 1;
};

/// Both pictures in the frame of the photo's close-up.
struct Frame {
    CloseUp photo;
    cv::Mat render;       ///< CV_32FC3 on the photo's pixels, black where the render ends
    cv::Mat render_mask;  ///< CV_8U, its outline, likewise
    OutlineMatch match;   ///< in pixels of the pictures as they were given
    /// Positions in the given pictures; `about` is the stone's centre in the photo.
    Similarity render_from_photo;
    double photo_diameter_px = 0, render_diameter_px = 0;
    std::string render_outline, render_warning;  ///< as in Silhouette: source and warning
    Cut render_cut;  ///< of the render, and where its pixels are seen from the photo's
    cv::Matx23d cut_from_photo;
};

/// The stone is compared at the smaller of its two sizes, and at `largest` pixels across at most:
/// sizes within 15 % are left alone, so that pictures of one size are not resampled but for the
/// registration.
Frame align(const Photo& photo, const Photo& render, double largest);

/// Another picture of the render's size and outline, moved as the render was.
cv::Mat moved_as_render(const Frame& frame, const Photo& picture);

/// The stone's diameter in the photo, pixels, as `align` finds it; 0 where it finds none.
double stone_diameter_px(const Photo& photo);

}  // namespace culet
