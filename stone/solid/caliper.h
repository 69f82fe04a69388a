#pragma once
// What a caliper measures on a stone that lies on its table: widths in plan.

#include <array>
#include <vector>

#include "stone/solid/solid.h"

namespace culet {

/// Lengths in the solid's unit. Azimuths are those of the direction from jaw to jaw, radians, 0 ..
/// pi.
struct CaliperWidths {
    double least = 0, largest = 0;
    double mean = 0;  ///< over all directions: perimeter of the outline / pi (Cauchy 1832)
    double least_azimuth = 0, largest_azimuth = 0;
    double length = 0;         ///< perpendicular to the least width
    std::vector<int> outline;  ///< the solid's vertices on the outline in plan, counter-clockwise
    std::size_t least_edge =
        0;  ///< index into `outline`: a jaw at the least width touches the edge that starts here
    std::array<std::size_t, 2> largest_between{};  ///< indices into `outline`
    /// The trade's definition: length and mean within 5 % of the least width.
    bool round() const;
};

/// All zero for a solid without extent in plan. For another `up` than z, azimuths count from the
/// direction nearest to x.
CaliperWidths caliper_widths(const Solid& solid, const Vec3& up = {0, 0, 1});

/// The directions perpendicular to `up` from which azimuths count.
struct PlanFrame {
    Vec3 x{1, 0, 0}, y{0, 1, 0};
};
PlanFrame plan_frame(const Vec3& up);

}  // namespace culet
