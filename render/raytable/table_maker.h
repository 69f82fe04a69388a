#pragma once
// Makes a ray table from the reference's light paths.

#include "render/raytable/ray_table.h"
#include "render/raytable/table_key.h"
#include "stone/progress/progress.h"

namespace culet {

/// Largest size of a table in bytes; scenes that need more are refused.
constexpr double k_most_table_bytes = 1e9;

/// Follows the paths behind every pixel of a renderable scene that is not refused, in the
/// reference's time per ray. The result does not depend on the number of threads. Throws InputError
/// if it would be too large, and Interrupted.
RayTable make_ray_table(const Scene& scene, const TableRays& rays, const Progress& progress);

}  // namespace culet
