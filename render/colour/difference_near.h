#pragma once
// Local linear form of CIEDE2000, for least squares.

#include <array>

namespace culet {

/// CIEDE2000 of a small change of linear sRGB is about the length of this matrix (rows: lightness,
/// chroma, hue) times the change. It omits the rotation of blue hues and G, which matter little
/// here.
using DifferenceNear = std::array<std::array<double, 3>, 3>;
DifferenceNear difference_near(double red, double green, double blue);

}  // namespace culet
