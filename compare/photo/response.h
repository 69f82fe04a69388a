#pragma once
// The response of a camera that writes 8-bit files, found from a series of exposures.

#include <vector>

#include "compare/photo/bracket.h"

namespace culet {

/// The curve of Debevec & Malik 1997 (OpenCV's createCalibrateDebevec), made increasing, the same
/// for all channels. Shots as
/// read by read_photo from 8-bit files, of one size, with their exposures; some thousand of their
/// pixels will do. Throws InputError when the series does not determine it.
ResponseCurve find_response(const std::vector<Photo>& shots, const std::vector<double>& exposures);

/// The photo's values, which are sRGB-decoded, replaced by the curve's.
void apply_response(const ResponseCurve& curve, Photo& photo);

}  // namespace culet
