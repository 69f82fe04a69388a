#pragma once
// From the ends of light paths to a ray table.

#include "render/geometry/stone_body.h"
#include "render/raytable/exit_sink.h"
#include "render/raytable/ray_table.h"

namespace culet {

/// What the table is made of; hits in the order of their rays, leaves by band and row of pixels.
struct TableContent {
    RayTableHeader header;  ///< but for what follows from the rest
    std::vector<double> wavelengths_nm;
    std::vector<std::uint32_t> hit_ray;
    std::vector<float> hit_distance;
    std::vector<std::vector<RowLeaves>> bands;
};

/// In-plane axes of each facet, in which leaves have their coordinates.
std::vector<PlaneAxes> plane_axes(const StoneBody& body, std::size_t facets);

RayTable assembled(TableContent content, const StoneBody& body, const std::vector<PlaneAxes>& axes);

}  // namespace culet
