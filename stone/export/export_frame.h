#pragma once
// The frame of files for other programs: millimetres, the girdle's plane at z = 0, the table up.

#include "stone/stone.h"

namespace culet {

/// The same stone in that frame: turned by the least rotation that brings its up direction to +z,
/// scaled to mm, and moved along z only. The girdle's plane is the middle of where the stone is
/// widest (`girdle_outline`). Throws InputError for a solid without extent.
Stone in_export_frame(const Stone& stone);

/// A convex stone with all corners on their planes. Where corners lie off by more than
/// `tolerance_mm`, the planes are intersected anew and edges shorter than that contracted. Other
/// solids are returned as they are.
Solid planar_solid(const Solid& solid, bool convex, double tolerance_mm);

/// A convex stone grown by `clearance` on every plane: the room that a seat for it needs. Every
/// point of its surface is at least `clearance` from the stone, exactly so above the facets; sharp
/// edges reach farther. Facets keep their names. Throws InputError for a stone that is not convex
/// and for a clearance that is not positive.
Solid grown_outward(const Solid& solid, double clearance);

}  // namespace culet
