#pragma once
// A camera that draws only the part of its picture where the stone is, at another scale.

#include <vector>

#include "render/scene/scene.h"

namespace culet {

/// Where the solid's corners lie in the camera's picture (pixels, corner of the first pixel at
/// (0, 0), as EyeRays has it). Corners behind the camera are left out.
std::vector<std::array<double, 2>> projected_corners(const Solid& solid, const Camera& camera);

/// Diameter of the circle that has the area of the corners' convex hull, in the camera's pixels.
double projected_diameter(const Solid& solid, const Camera& camera);

/// The same view, cut to the stone's corners with `margin` (of the diameter) around them, with the
/// stone `diameter` pixels across. Throws InputError when the camera does not see the stone, or
/// when it is a conoscope or a dichroscope, whose pictures cannot be cut.
Camera cropped_to_stone(const Camera& camera, const Solid& solid, double diameter, double margin);

}  // namespace culet
