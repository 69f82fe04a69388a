#pragma once
// What the reader and the writer of Gem Cut Studio's .gcs share.
//
// Facts of the format, from its published description and files: XML; <index gear>; <tier angle
// depth name instructions visible guide> with the polar angle of its normals (0 table, 90
// girdle, 180 flat culet) and their distance from the origin; <facet nx ny nz index_angle frosting>
// with its corners; <render> and <info>. The stone fills the square of half width 1 about the axis,
// and its middle height is 0. Its y is minus GemCad's: seen from above, index settings of the crown
// run counter-clockwise from -y in both programs. `index_angle` is the tooth in degrees, counted
// the other way on the pavilion and the girdle, since the transfer turns the stone over.

#include <array>
#include <cmath>

#include "stone/numbers/units.h"
#include "stone/solid/solid.h"

namespace culet {

/// The lines above and below a design. What has no place of its own follows in the last one.
inline constexpr std::array<const char*, 5> k_gcs_headings{"title", "author", "date", "header2",
                                                           "header3"};
inline constexpr std::array<const char*, 4> k_gcs_footnotes{"footer1", "footer2", "footer3",
                                                            "footer4"};

/// Its own inverse.
inline Vec3 gcs_turned(const Vec3& v) {
    return {v.x, -v.y, v.z};
}

/// Degrees in [0, 360), of a normal in culet's frame.
inline double gcs_index_angle(const Vec3& normal) {
    constexpr double k_girdle = 1e-8;
    const double turn = degrees(std::atan2(normal.x, normal.y));
    const double angle = normal.z > k_girdle ? turn : -turn;
    return angle < 0 ? angle + 360 : angle + 0.0;
}

}  // namespace culet
