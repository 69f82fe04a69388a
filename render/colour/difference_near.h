#pragma once
// Local linear form of CIEDE2000, for least squares.

#include <array>

namespace culet {

/// For a small change of linear sRGB, CIEDE2000 is about the length of this matrix (rows:
/// lightness, chroma, hue) times the change, without the rotation of blue hues and G, which matter
/// little.
using DifferenceNear = std::array<std::array<double, 3>, 3>;
DifferenceNear difference_near(double red, double green, double blue);

}  // namespace culet
