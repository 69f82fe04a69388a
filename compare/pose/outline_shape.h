#pragma once
// An outline as the distances of its tangents from a point (its support function). Fitting a
// stone's outline to it gives size and place in closed form.

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

/// From the convex hull of a mask's pixels (their areas, not their centres).
OutlineShape outline_shape(const cv::Mat& mask);

struct FittedOutline {
    StoneView view;
    double rms = 0;  ///< root mean square of the tangents' residuals, pixels
};

/// Least squares over the tangents, in two rounds because the perspective depends on the size.
/// `focal_px` 0: orthographic.
FittedOutline fit_outline(const WireSolid& wire, const OutlineShape& shape, const StoneView& start,
                          double focal_px);

}  // namespace culet
