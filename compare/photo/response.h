#pragma once
// Finds an 8-bit camera's response from a series of exposures.

#include <vector>

#include "compare/photo/bracket.h"

namespace culet {

/// The curve of Debevec & Malik 1997 (OpenCV's createCalibrateDebevec), made increasing and the
/// same for all channels. `shots`: as read_photo reads 8-bit files, of one size; about a thousand
/// pixels are enough. Throws InputError when they do not determine the curve.
ResponseCurve find_response(const std::vector<Photo>& shots, const std::vector<double>& exposures);

/// Replaces sRGB-decoded values by the curve's.
void apply_response(const ResponseCurve& curve, Photo& photo);

}  // namespace culet
