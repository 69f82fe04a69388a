#pragma once
// CIEDE2000 near one colour, for least squares.

#include <array>

namespace culet {

/// Near one colour: CIEDE2000 is the length of this matrix (by rows: lightness, chroma, hue) times
/// a small change of linear sRGB. Without the turn of blue hues and G, which sharpen it little.
using DifferenceNear = std::array<std::array<double, 3>, 3>;
DifferenceNear difference_near(double red, double green, double blue);

}  // namespace culet
