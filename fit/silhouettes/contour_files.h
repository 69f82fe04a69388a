#pragma once
// Reads files of outlines.

#include <filesystem>
#include <vector>

#include "fit/silhouettes/silhouette.h"
#include "stone/numbers/units.h"

namespace culet {

/// Reads `{"unit", "contours": [{"direction": [..], "points": [[..], ..], "sigma", "weight"}]}`.
/// Lengths are in `unit` (else the stone's) and are converted to `stone_unit`. `sigma` applies to
/// contours that state none. Throws InputError.
std::vector<Contour> read_contours(const std::filesystem::path& file, LengthUnit stone_unit,
                                   double sigma = 0);

/// A scanner's shadow contours (docs/silhouettes.md), in mm. Every measured side (confidence above
/// 0) gives points that represent its fitted line.
struct ShadowContours {
    std::vector<Contour> contours;
    int sides_left_out = 0;  ///< sides with zero confidence
};
ShadowContours read_shadow_contours(const std::filesystem::path& file, LengthUnit stone_unit,
                                    double sigma = 0);

/// The measured points of one outline given as a polygon. In a polygon of few corners the sides
/// were measured: each gives two points, so there are as many numbers as its corners have. In one
/// of many corners each corner is a measured point. Throws InputError with what is wrong.
Contour contour_of_polygon(const Vec3& direction, const std::vector<Vec3>& corners, double sigma,
                           double weight);

}  // namespace culet
