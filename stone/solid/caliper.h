#pragma once
// What a caliper reads of a stone that stands on its table: widths in plan.

#include <array>
#include <vector>

#include "stone/solid/solid.h"

namespace culet {

/// Lengths in the solid's unit; azimuths in radians, 0 .. pi, of the direction from jaw to jaw.
struct CaliperWidths {
    double least = 0, largest = 0;
    double mean = 0;  ///< over all directions: perimeter of the outline / pi (Cauchy 1832)
    double least_azimuth = 0, largest_azimuth = 0;
    double length = 0;         ///< across the least width
    std::vector<int> outline;  ///< the solid's vertices on the outline in plan, counter-clockwise
    std::size_t least_edge =
        0;  ///< from this one of `outline`: on it lies a jaw of the least width
    std::array<std::size_t, 2> largest_between{};  ///< of `outline`
    /// As the trade has it: length and mean within 5 % of the least width.
    bool round() const;
};

/// Zero for a solid without extent in plan. Azimuths are those of a stone with z up; for another
/// `up` they count about it from the direction nearest to x.
CaliperWidths caliper_widths(const Solid& solid, const Vec3& up = {0, 0, 1});

/// The directions across `up` from which azimuths count: x, y.
struct PlanFrame {
    Vec3 x{1, 0, 0}, y{0, 1, 0};
};
PlanFrame plan_frame(const Vec3& up);

}  // namespace culet
