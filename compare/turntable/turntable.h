#pragma once
// How a turntable stood before the camera, found from the outlines of what turned on it.

#include <string>
#include <vector>

#include "compare/turntable/back_lit_outline.h"
#include "stone/solid/solid.h"

namespace culet {

/// Of a camera far away or with a telecentric lens, so that lines of sight are parallel. The
/// turntable's axis is +z of the stone's frame, the first line of sight lies over +x.
struct Turntable {
    double axis_px = 0;    ///< where the axis crosses the picture's middle row, from its middle
    double roll = 0;       ///< of the axis in the picture, radians, clockwise
    double elevation = 0;  ///< of the camera above the table's plane, radians
    /// Root mean square of what outlines disagree by where both touch one plane, pixels.
    double residual_px = 0;
    int tangents = 0;  ///< such planes
    /// Standard uncertainties from the residuals.
    double sigma_axis_px = 0, sigma_roll = 0, sigma_elevation = 0;
    /// Why the outlines are of no use, and what to do about it: sentences for people. Empty when
    /// all is well.
    std::string trouble, remedy;
};

/// `step`: radians that the stone turned from one outline to the next, counter-clockwise as seen
/// from above. The plane through two lines of sight that touches the stone is seen in both
/// outlines, at one height over the axis (Wong and Cipolla 2001, Cipolla and Giblin 2000); opposite
/// outlines are as far from the axis on one side as on the other. Throws InputError with fewer
/// than three outlines, or where nothing tells the axis' place: no two of them are opposite.
Turntable turntable_of(const std::vector<BackLitOutline>& outlines, double step);

/// Places of file names in the order of the numbers in them: turn-2 comes before turn-10, which a
/// shell lists first.
std::vector<std::size_t> order_of_numbers(const std::vector<std::string>& names);

/// One outline in the stone's frame, `scale` lengths a pixel.
struct PlacedOutline {
    Vec3 direction{1, 0, 0};  ///< of the line of sight, towards the camera
    std::vector<Vec3> points;
};
std::vector<PlacedOutline> placed(const std::vector<BackLitOutline>& outlines, double step,
                                  const Turntable& table, double scale);

/// The widest and narrowest that the outlines are across the axis, pixels: what calipers would
/// find.
struct OutlineWidths {
    double least = 0, largest = 0;
};
OutlineWidths widths_of(const std::vector<BackLitOutline>& outlines, const Turntable& table);

}  // namespace culet
