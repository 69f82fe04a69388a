#pragma once
// Makes a ray table: the reference's light paths, kept instead of lit.

#include "render/raytable/ray_table.h"
#include "render/raytable/table_key.h"
#include "stone/progress/progress.h"

namespace culet {

/// A table is no larger, in bytes; a scene that asks for more is refused.
constexpr double k_most_table_bytes = 1e9;

/// Follows the paths behind every pixel of a scene that is renderable and not refused. The same
/// table whatever the number of threads. Throws InputError where it would be too large, and
/// Interrupted. Time: that of the reference, per ray.
RayTable make_ray_table(const Scene& scene, const TableRays& rays, const Progress& progress);

}  // namespace culet
