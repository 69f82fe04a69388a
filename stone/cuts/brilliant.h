#pragma once
// The brilliant family: stars, mains and halves around any outline.

#include <optional>

#include "stone/cuts/outline.h"
#include "stone/solid/solid.h"

namespace culet {

struct BrilliantProportions {
    double table = 0.57;        ///< table corners as a fraction of the outline
    double crown_height = 1;    ///< mm, from the girdle's upper edge to the table
    double pavilion_depth = 1;  ///< mm, from the girdle's lower edge to the culet
    double girdle = 0.1;        ///< mm
    double star = 0.5;  ///< end of the star seen from above: 0 where the mains meet at table level,
                        ///< 1 at the girdle (see star_of_length)
    double lower_half =
        0.77;          ///< lower half length / distance from girdle to culet, seen from above
    double culet = 0;  ///< diameter of the culet facet / that of the outline; 0: a point
};

/// Converts the trade's star length (round stones: share of the way from the table edge's middle to
/// the girdle, from above). Throws InputError when the star would end before the mains meet.
double star_of_length(double star_length, double table, int mains);

/// Mains pass through the table's corner, the girdle's main point and (pavilion) the culet; stars
/// and halves through the meets that their lengths set on the edges between mains. Throws
/// InputError when a length leaves no room for its neighbours.
Solid brilliant(const Outline& outline, const BrilliantProportions& proportions);

}  // namespace culet
