#pragma once
// Pictures from a ray table.

#include "render/engine/render_result.h"
#include "render/raytable/exit_shader.h"
#include "render/raytable/ray_table.h"
#include "render/raytable/table_key.h"
#include "stone/progress/progress.h"

namespace culet {

/// Draws a scene that fits the table (difference_to is empty), in the scene's lights and with its
/// stone's absorption, without tracing. The bytes do not depend on the number of threads; other
/// instruction sets differ in the last digits. Throws Interrupted.
///
/// `stats.remainder` and `cut` are the table's, for a clear stone; they bound those of one that
/// absorbs. `absorbed` is what exit events lose on their way through the stone.
RenderResult relit(const RayTable& table, const Scene& scene, const TableRays& rays,
                   const Progress& progress, ExitPrecision precision = ExitPrecision::fastest);

}  // namespace culet
