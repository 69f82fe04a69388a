#pragma once
// Assembles a ray table from exit events.

#include "render/geometry/stone_body.h"
#include "render/raytable/exit_sink.h"
#include "render/raytable/ray_table.h"

namespace culet {

/// Hits in the order of their rays; exit events by band and row of pixels.
struct TableContent {
    RayTableHeader header;  ///< except what follows from the rest
    std::vector<double> wavelengths_nm;
    std::vector<std::uint32_t> hit_ray;
    std::vector<float> hit_distance;
    std::vector<std::vector<RowExits>> bands;
};

/// In-plane axes of each facet, in which exit events have their coordinates.
std::vector<PlaneAxes> plane_axes(const StoneBody& body, std::size_t facets);

RayTable assembled(TableContent content, const StoneBody& body, const std::vector<PlaneAxes>& axes);

}  // namespace culet
