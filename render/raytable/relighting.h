#pragma once
// Pictures from a ray table.

#include "render/engine/render_result.h"
#include "render/raytable/exit_shader.h"
#include "render/raytable/ray_table.h"
#include "render/raytable/table_key.h"
#include "stone/progress/progress.h"

namespace culet {

/// The picture of a scene that a table fits (difference_to is empty) in the scene's lights, with
/// the absorption of its stone. Nothing is traced. The same bytes whatever the number of threads;
/// processors of another instruction set differ in last digits. Throws Interrupted.
///
/// `stats.remainder` and `cut` are those of the table, of a clear stone, which one that absorbs
/// does not exceed; `absorbed` is what leaves lose on the way to where they leave.
RenderResult relit(const RayTable& table, const Scene& scene, const TableRays& rays,
                   const Progress& progress, ExitPrecision precision = ExitPrecision::fastest);

}  // namespace culet
