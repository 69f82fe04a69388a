#pragma once
// The frame of files for other programs: millimetres, the girdle's plane at z = 0, the table up.

#include "stone/stone.h"

namespace culet {

/// The same stone in that frame: turned by the least rotation that brings its own up direction to
/// +z, in mm, and moved along z alone. The girdle's plane is the middle of where the stone is
/// widest (`girdle_outline`). Throws InputError for a solid without extent.
Stone in_export_frame(const Stone& stone);

/// The solid of a convex stone with no corner off its planes: the planes met anew where corners lie
/// off them by more than `tolerance_mm`, edges shorter than that contracted. Others as they are.
Solid planar_solid(const Solid& solid, bool convex, double tolerance_mm);

/// A convex stone grown by `clearance` on every plane: what a seat for it takes away. Every point
/// of its surface is at least so far from the stone, and above the facets exactly so far; sharp
/// edges reach farther. Facets keep their names. Throws InputError for a stone that is not convex
/// and for a clearance that is no positive length.
Solid grown_outward(const Solid& solid, double clearance);

}  // namespace culet
