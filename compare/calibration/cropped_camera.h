#pragma once
// A camera that draws only the part of its picture where the stone is, at another scale.

#include <vector>

#include "compare/photo/photo.h"
#include "render/scene/scene.h"

namespace culet {

/// Where the solid's corners lie in the camera's picture (pixels, corner of the first pixel at
/// (0, 0), as EyeRays has it). Corners behind the camera are left out.
std::vector<std::array<double, 2>> projected_corners(const Solid& solid, const Camera& camera);

/// Diameter of the circle that has the area of the corners' convex hull, in the camera's pixels.
double projected_diameter(const Solid& solid, const Camera& camera);

/// Around a stone that is compared, of its diameter.
constexpr double k_stone_margin = 0.18;

/// The same view, cut to the stone's corners with `margin` (of the diameter) around them, with the
/// stone `diameter` pixels across. Throws InputError when the camera does not see the stone, or
/// when it is a conoscope or a dichroscope, whose pictures cannot be cut.
Camera cropped_to_stone(const Camera& camera, const Solid& solid, double diameter, double margin);

/// For a render that is laid on the photo: the camera cut to the stone, which it shows as large as
/// the photo does, `largest` pixels across at most.
Camera camera_for(const Photo& photo, const Camera& camera, const Solid& solid, double largest);

}  // namespace culet
