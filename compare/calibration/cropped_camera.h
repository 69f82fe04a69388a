#pragma once
// A camera that draws only the part of its picture that shows the stone, at another scale.

#include <vector>

#include "compare/photo/photo.h"
#include "render/scene/scene.h"

namespace culet {

/// Where the solid's corners lie in the picture (pixels, corner of the first pixel at (0, 0), as in
/// EyeRays). Corners behind the camera are left out.
std::vector<std::array<double, 2>> projected_corners(const Solid& solid, const Camera& camera);

/// Diameter of the circle with the area of the corners' convex hull, in the camera's pixels.
double projected_diameter(const Solid& solid, const Camera& camera);

/// Margin around a compared stone, as a share of its diameter.
constexpr double k_stone_margin = 0.18;

/// The same view, cut to the stone's corners plus `margin` (a share of the diameter), with the
/// stone `diameter` pixels across. Throws InputError when the camera does not see the stone, and
/// for a conoscope or a dichroscope, whose pictures cannot be cut.
Camera cropped_to_stone(const Camera& camera, const Solid& solid, double diameter, double margin);

/// The camera for a render that is registered with the photo: cut to the stone, and showing it as
/// large as the photo does, at most `largest` pixels across.
Camera camera_for(const Photo& photo, const Camera& camera, const Solid& solid, double largest);

}  // namespace culet
