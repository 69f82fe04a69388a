#pragma once
// Reads files of outlines.

#include <filesystem>
#include <vector>

#include "fit/silhouettes/silhouette.h"
#include "stone/numbers/units.h"

namespace culet {

/// Reads `{"unit", "contours": [{"direction": [..], "points": [[..], ..], "sigma", "weight"}]}`,
/// with lengths in `unit` (else the stone's), converted to `stone_unit`. `sigma`: of contours that
/// state none. Throws InputError.
std::vector<Contour> read_contours(const std::filesystem::path& file, LengthUnit stone_unit,
                                   double sigma = 0);

/// A scanner's shadow contours (docs/silhouettes.md), in mm: points that represent the fitted line
/// of every measured side (confidence above 0).
struct ShadowContours {
    std::vector<Contour> contours;
    int sides_left_out = 0;  ///< sides with zero confidence
};
ShadowContours read_shadow_contours(const std::filesystem::path& file, LengthUnit stone_unit,
                                    double sigma = 0);

/// Measured points of an outline given as a polygon. With few corners its sides were measured: each
/// gives two points, as many numbers as the corners have. With many, each corner is a point. Throws
/// InputError with what is wrong.
Contour contour_of_polygon(const Vec3& direction, const std::vector<Vec3>& corners, double sigma,
                           double weight);

}  // namespace culet
