#pragma once
// Files of outlines.

#include <filesystem>
#include <vector>

#include "fit/silhouettes/silhouette.h"
#include "stone/numbers/units.h"

namespace culet {

/// `{"unit", "contours": [{"direction": [..], "points": [[..], ..], "sigma", "weight"}]}`, lengths
/// as `unit` has them (else the stone's) made into those of `stone_unit`. `sigma`: of contours that
/// state none. Throws InputError.
std::vector<Contour> read_contours(const std::filesystem::path& file, LengthUnit stone_unit,
                                   double sigma = 0);

/// A scanner's shadow contours (docs/silhouettes.md), in mm: of each side that was measured
/// (confidence above 0), points that stand for the line that was fitted to it.
struct ShadowContours {
    std::vector<Contour> contours;
    int sides_left_out = 0;  ///< of no confidence
};
ShadowContours read_shadow_contours(const std::filesystem::path& file, LengthUnit stone_unit,
                                    double sigma = 0);

/// The measured points of one outline that is given as a polygon. A polygon of few corners is one
/// of measured sides: each stands for two points of it, as many numbers as its corners have. Of
/// many, each corner is a point that was measured. Throws InputError with what is wrong.
Contour contour_of_polygon(const Vec3& direction, const std::vector<Vec3>& corners, double sigma,
                           double weight);

}  // namespace culet
