#pragma once
// A camera that shows only the stone's part of a picture, at another scale.

#include <vector>

#include "compare/photo/photo.h"
#include "render/scene/scene.h"

namespace culet {

/// The solid's visible corners (in front of the camera), in pixels with the corner of the first
/// pixel at (0, 0) as in EyeRays.
std::vector<std::array<double, 2>> projected_corners(const Solid& solid, const Camera& camera);

/// Diameter of the circle with the area of the corners' convex hull, pixels.
double projected_diameter(const Solid& solid, const Camera& camera);

/// Around a compared stone, share of its diameter.
constexpr double k_stone_margin = 0.18;

/// The same view, cut to the stone's corners plus `margin` (a share of the diameter), the stone
/// `diameter` pixels across. Throws InputError for a camera that does not see the stone, a
/// conoscope or a dichroscope.
Camera cropped_to_stone(const Camera& camera, const Solid& solid, double diameter, double margin);

/// The camera for a render to be registered with the photo: cut to the stone, and as large as in
/// the photo, at most `largest` pixels across.
Camera camera_for(const Photo& photo, const Camera& camera, const Solid& solid, double largest);

}  // namespace culet
