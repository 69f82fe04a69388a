#pragma once
// The ray table of a view, interpolated from those of stored views (after Lee 2004, chapter 6).
//
// Each eye ray of the view passes through a point of the plane through the camera's look_at,
// perpendicular to the line of sight. Each stored view has a ray to about that point, through the
// same front facet if one is near. Where these rays meet the same facets, their exits are merged
// into one, with interpolated directions, points, lengths and weights. Otherwise the exits of each
// are kept with its weight. Only the eye rays' entry into the stone is traced. The error is not
// bounded; docs/ray-tables.md has measurements.

#include "bench/stored_views.h"
#include "render/raytable/ray_table.h"
#include "render/raytable/table_key.h"
#include "stone/progress/progress.h"

namespace culet {

struct ViewTable {
    StoredView view;
    RayTable table;
};

/// `tables` are of the same scene, from the views of stored_views. The result is the same for any
/// number of threads. Throws Interrupted.
RayTable interpolated(const Scene& scene, const TableRays& rays,
                      const std::vector<ViewTable>& tables, const Progress& progress);

}  // namespace culet
