#pragma once
// An outline as the distances of its tangents from a point (its support function), and how a
// stone's outline from some side fits it: size and place follow from it in closed form.

#include <array>
#include <opencv2/core/mat.hpp>

#include "compare/pose/stone_view.h"
#include "compare/pose/wireframe.h"

namespace culet {

constexpr int k_tangents = 72;

struct OutlineShape {
    /// Largest x cos a + y sin a over the outline, at angles a = 2 pi k / k_tangents.
    std::array<double, k_tangents> reach{};
    PicturePoint middle;  ///< mean position of the area
    double diameter = 0;  ///< of the circle of the same area
};

/// Of the convex hull of a mask's pixels (their areas, not their centres).
OutlineShape outline_shape(const cv::Mat& mask);

/// A view with size and place such that the stone's outline fits, turned as given.
struct FittedOutline {
    StoneView view;
    double rms = 0;  ///< of the distances between tangents, pixels
};

/// `focal_px` 0: orthographic. Least squares over the tangents; a second round takes the
/// perspective at the size found in the first.
FittedOutline fit_outline(const WireSolid& wire, const OutlineShape& shape, const StoneView& start,
                          double focal_px);

}  // namespace culet
