#pragma once
// Cuts the stone out of both pictures at one size and registers the render with the photo.

#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "compare/photo/photo.h"
#include "compare/registration/registration.h"

namespace culet {

/// Where a picture shows its stone: by its mask, otherwise its coverage, otherwise the background.
struct StoneSource {
    cv::Mat colour;             ///< CV_32FC3, linear: the photo's own pixels
    cv::Mat coverage;           ///< CV_32F; empty: use the background
    std::string coverage_name;  ///< "mask" or "coverage"
};
StoneSource stone_source(const Photo& photo);
Silhouette silhouette_of(const StoneSource& source);

/// The part of a picture around its stone, possibly reduced. A point p of the close-up lies at (p +
/// 0.5) / scale - 0.5 + corner in the picture.
struct CloseUp {
    cv::Mat colour;  ///< CV_32FC3, linear
    Silhouette silhouette;
    cv::Mat ignored;  ///< CV_8U, 255 where nothing is compared; empty: nowhere
    double scale = 1;
    cv::Point2d corner;
    cv::Point2d in_picture(const cv::Point2d& p) const;
};

/// The part that was cut out of a picture, and its reduction.
struct Cut {
    cv::Rect box;
    double scale = 1;
};

/// Both pictures in the frame of the photo's close-up.
struct Frame {
    CloseUp photo;
    cv::Mat render;       ///< CV_32FC3 on the photo's pixels, black beyond the render
    cv::Mat render_mask;  ///< CV_8U, its outline, likewise
    OutlineMatch match;   ///< in pixels of the given pictures
    /// Positions in the given pictures; `about` is the stone's centre in the photo.
    Similarity render_from_photo;
    double photo_diameter_px = 0, render_diameter_px = 0;
    std::string render_outline, render_warning;  ///< as in Silhouette: source and warning
    Cut render_cut;  ///< of the render; `cut_from_photo` maps the photo's close-up to its pixels
    cv::Matx23d cut_from_photo;
};

/// Compares at the smaller of the stone's two sizes, at most `largest` pixels across. Leaves sizes
/// within 15 % alone, so that pictures of equal size are resampled only by the registration.
Frame align(const Photo& photo, const Photo& render, double largest);

/// Another picture of the render's size and outline, moved as the render was.
cv::Mat moved_as_render(const Frame& frame, const Photo& picture);

/// The stone's diameter in the photo, pixels, as `align` finds it; 0: not found.
double stone_diameter_px(const Photo& photo);

}  // namespace culet
