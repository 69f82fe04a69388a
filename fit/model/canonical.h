#pragma once
// The canonical polyhedron of a solid's topology: its edges all touch the unit sphere, and the mean
// of the touching points is the centre. Every solid with the topology of a convex one has exactly
// one (Koebe, Andreev, Thurston; Springborn 2005), with all the symmetry that the topology allows.
// It does not depend on the positions of the mesh's corners.

#include <optional>

#include "fit/model/shape.h"
#include "stone/solid/half_edges.h"
#include "stone/solid/solid.h"

namespace culet {

/// Returns normals, offsets and points in the solid's order, without extras. Nothing when the
/// topology is not that of a convex solid (two facets share two edges, say).
std::optional<Shape> canonical_polyhedron(const Solid& solid, const HalfEdges& edges);

/// Whether the mesh is a mirror image or its facets run clockwise seen from outside: the canonical
/// polyhedron fits it better when mirrored. Unlike the sign of the volume, this does not depend on
/// a few wild corners. Without a canonical polyhedron the sign of the volume decides.
bool lies_mirrored(const Solid& solid, const HalfEdges& edges);

}  // namespace culet
