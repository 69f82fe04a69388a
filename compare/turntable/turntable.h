#pragma once
// A turntable's pose before the camera, from outlines of what turned on it.

#include <string>
#include <vector>

#include "compare/turntable/back_lit_outline.h"
#include "stone/solid/solid.h"

namespace culet {

/// For a distant camera or a telecentric lens, so that lines of sight are parallel. The turntable's
/// axis is +z of the stone's frame; the first line of sight is over +x.
struct Turntable {
    double axis_px = 0;    ///< where the axis crosses the picture's middle row, from its middle
    double roll = 0;       ///< of the axis in the picture, radians, clockwise
    double elevation = 0;  ///< of the camera above the table's plane, radians
    /// Root mean square disagreement of outlines at common tangent planes, pixels.
    double residual_px = 0;
    int tangents = 0;  ///< number of such planes
    /// Standard uncertainties from the residuals.
    double sigma_axis_px = 0, sigma_roll = 0, sigma_elevation = 0;
    /// Why the outlines cannot be used, and what to do, for people; empty: they can.
    std::string trouble, remedy;
};

/// `step`: rotation from one outline to the next, radians, counter-clockwise from above. A tangent
/// plane through two lines of sight appears in both outlines at the same height along the axis
/// (Wong and Cipolla 2001, Cipolla and Giblin 2000), and opposite outlines are equally far from the
/// axis. Throws InputError with fewer than three outlines, or without opposite ones, when the axis'
/// place is not identifiable.
Turntable turntable_of(const std::vector<BackLitOutline>& outlines, double step);

/// By the numbers in the names: turn-2 comes before turn-10, which a shell lists first.
std::vector<std::size_t> order_of_numbers(const std::vector<std::string>& names);

/// One outline in the stone's frame, `scale` lengths per pixel.
struct PlacedOutline {
    Vec3 direction{1, 0, 0};  ///< of the line of sight, towards the camera
    std::vector<Vec3> points;
};
std::vector<PlacedOutline> placed(const std::vector<BackLitOutline>& outlines, double step,
                                  const Turntable& table, double scale);

/// Across the axis, pixels, as calipers would measure.
struct OutlineWidths {
    double least = 0, largest = 0;
};
OutlineWidths widths_of(const std::vector<BackLitOutline>& outlines, const Turntable& table);

}  // namespace culet
