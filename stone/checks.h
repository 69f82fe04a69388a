#pragma once
// What is wrong with a solid, in words. All decisions about sides use exact predicates (CGAL).

#include <string>
#include <vector>

#include "stone/solid.h"

namespace culet {

enum class FaultKind {
    empty,             ///< no facets
    not_finite,        ///< a coordinate is NaN or infinite
    degenerate_facet,  ///< fewer than three distinct corners, or no area
    open,              ///< an edge with one facet only
    not_manifold,    ///< an edge with more than two facets, or a vertex whose facets are no single
                     ///< fan
    misoriented,     ///< neighbouring facets run the same way along their edge
    inside_out,      ///< closed, but the volume is negative
    several_pieces,  ///< more than one connected part
    not_planar,      ///< a corner lies off its facet's plane by more than the limit
    not_convex,      ///< a corner lies above a facet's plane
    self_crossing,   ///< a facet's outline crosses itself
    unused_vertex,
    repeated_name,
    missing_facet,  ///< a plane of the file bounds nothing
    repeated_plane,
};

struct Fault {
    FaultKind kind;
    std::string what;  ///< one line with the names of facets or vertices
};

struct CheckLimits {
    double planarity = 1e-9;  ///< as a fraction of the diameter
    bool must_be_convex = true;
};

/// Faults, the worst kind first; empty for a sound solid.
std::vector<Fault> find_faults(const Solid& solid, const CheckLimits& limits = {});

/// Every facet outline is a simple convex polygon, the surface is closed, and every corner lies on
/// or below every facet's plane: decided by exact orientation of corners, so independent of scale.
bool is_closed(const Solid& solid);
bool is_convex(const Solid& solid);

const char* name_of(FaultKind kind);

}  // namespace culet
