#pragma once
// The brilliant family: stars, mains and halves round any outline.

#include <optional>

#include "stone/cuts/outline.h"
#include "stone/solid/solid.h"

namespace culet {

struct BrilliantProportions {
    double table = 0.57;        ///< table corners as a fraction of the outline
    double crown_height = 1;    ///< mm, from the girdle's upper edge to the table
    double pavilion_depth = 1;  ///< mm, from the girdle's lower edge to the culet
    double girdle = 0.1;        ///< mm
    double star =
        0.5;  ///< where the star ends, of the way from the mains' meeting at the table's level
              ///< to the girdle, seen from above (star_of_length converts the trade's star length)
    double lower_half =
        0.77;          ///< lower half length over the distance from girdle to culet, from above
    double culet = 0;  ///< diameter of the culet facet over that of the outline; 0: a point
};

/// `star` of a star length as the trade measures it on a round stone: of the way from the middle of
/// the table's edge to the girdle, seen from above. Throws InputError when the star would end
/// before the mains meet.
double star_of_length(double star_length, double table, int mains);

/// Mains pass through the table's corner, the girdle's main point and (pavilion) the culet; stars
/// and halves through the meets that star and lower half lengths set on the edges between mains.
/// Throws InputError when a length leaves no room for its neighbours.
Solid brilliant(const Outline& outline, const BrilliantProportions& proportions);

}  // namespace culet
