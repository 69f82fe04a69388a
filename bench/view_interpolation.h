#pragma once
// The ray table of a view between others (after Lee 2004, chapter 6).
//
// Each eye ray of the view passes a point of the plane through the camera's look_at across the line
// of sight; each stored view has a ray to about that point, through the same front facet if one is
// near. Where these rays go by the same facets, their leaves are one each: directions, points,
// lengths and weights between. Where not, the leaves of each are kept with its share. Nothing is
// traced but where eye rays meet the stone. The error is not bounded; docs/ray-tables.md has what
// was measured.

#include "bench/stored_views.h"
#include "render/raytable/ray_table.h"
#include "render/raytable/table_key.h"
#include "stone/progress/progress.h"

namespace culet {

struct ViewTable {
    StoredView view;
    RayTable table;
};

/// `tables`: of the same scene from the views of stored_views. The same table whatever the number
/// of threads. Throws Interrupted.
RayTable interpolated(const Scene& scene, const TableRays& rays,
                      const std::vector<ViewTable>& tables, const Progress& progress);

}  // namespace culet
