#pragma once
// The ratios by which the trade describes a cut, as GemCad prints them.

#include <optional>

#include "stone/solid/solid.h"

namespace culet {

/// Lengths in the solid's unit; z is up. Ratios are to `width`.
struct Proportions {
    double width = 0, length = 0;  ///< extent along x and y, the smaller first
    double height = 0;             ///< along z: pavilion, girdle and crown
    /// Pavilion: from the lowest point to the highest corner of a pavilion facet. Crown: from the
    /// highest point to the lowest corner of a crown facet. Neither includes the girdle.
    double pavilion = 0, crown = 0;
    /// The table's extent along the length and along the width; empty without a table.
    std::optional<double> table_length, table_width;
};

/// Girdle facets are those from 89 degrees on. The table is the largest facet that faces up within
/// 5 degrees of the vertical and reaches the top (the tables of real designs are tilted by up to a
/// few degrees).
Proportions proportions(const Solid& solid);

}  // namespace culet
