#pragma once
// The frame of files for other programs: millimetres, the girdle's plane at z = 0, the table up.

#include "stone/stone.h"

namespace culet {

/// Turns the stone by the least rotation that brings its up direction to +z, scales it to mm, and
/// moves it along z only. The girdle's plane is the middle of where the stone is widest
/// (`girdle_outline`). Throws InputError for a solid without extent.
Stone in_export_frame(const Stone& stone);

/// Puts all corners of a convex stone on their planes: intersects the planes anew where corners are
/// off by more than `tolerance_mm`, and contracts edges shorter than that. Other solids are
/// unchanged.
Solid planar_solid(const Solid& solid, bool convex, double tolerance_mm);

/// A convex stone grown by `clearance` on every plane: the room that a seat needs. Its surface is
/// `clearance` from the stone above the facets, farther at sharp edges. Facets keep their names.
/// Throws InputError for a stone that is not convex and for a clearance that is not positive.
Solid grown_outward(const Solid& solid, double clearance);

}  // namespace culet
