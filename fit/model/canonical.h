#pragma once
// The canonical polyhedron of a solid's facets and meets: the one whose edges all touch the unit
// sphere, with the mean of the touching points in its middle. Every solid whose facets meet as
// those of a convex one has exactly one (Koebe, Andreev, Thurston; Springborn 2005), with all the
// symmetry that who meets whom allows. It owes nothing to where the mesh's corners lie.

#include <optional>

#include "fit/model/shape.h"
#include "stone/solid/half_edges.h"
#include "stone/solid/solid.h"

namespace culet {

/// Normals, offsets and points in the solid's order; no extras. Nothing when the facets do not meet
/// as those of a convex solid (two facets that share two edges, say).
std::optional<Shape> canonical_polyhedron(const Solid& solid, const HalfEdges& edges);

/// Whether the corners lie as in a mirror, or the facets run clockwise seen from outside: the
/// canonical polyhedron would have to be mirrored to lie nearest to the mesh. Unlike the sign of
/// the volume this is no matter of a few wild corners. False when there is no canonical polyhedron.
bool lies_mirrored(const Solid& solid, const HalfEdges& edges);

}  // namespace culet
