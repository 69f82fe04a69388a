#pragma once
// What is wrong with a solid, in words. All decisions about sides use exact predicates (CGAL).

#include <string>
#include <vector>

#include "stone/solid/solid.h"

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
    /// As a fraction of the diameter; where the coordinates are so large that their own rounding is
    /// more, that is allowed.
    double planarity = 1e-9;
    bool must_be_convex = true;
};

/// Faults, the worst kind first; empty for a sound solid. Of one kind only the first twenty are
/// listed, then one line says how many more there are. Kinds that mean nothing for so broken a
/// solid are left out (whether an open surface is convex, say).
std::vector<Fault> find_faults(const Solid& solid, const CheckLimits& limits = {});

/// Each edge has two facets that run along it in opposite ways, and round each vertex there is one
/// fan of facets. Says nothing of pieces or of inside and outside.
bool is_closed(const Solid& solid);

/// Closed, every outline a convex polygon, and no corner above a facet's plane: decided by exact
/// orientation of corners, so independent of scale. A corner is forgiven when it is off by no more
/// than the corners of this solid are off their own facets' planes (`planarity`), and never by more
/// than `k_largest_miss` of the diameter: a design with near-miss meets is convex, a fitted stone
/// (planar to rounding) with a flipped edge is not.
bool is_convex(const Solid& solid);

/// The largest distance of a corner from the body that the facets' planes bound, which lies within
/// a closed mesh: how far another body is drawn when a stone is drawn as convex. Infinite when the
/// planes bound none.
double distance_from_planes_body(const Solid& solid);

/// As far as the meets of a real cut design miss, as a fraction of the diameter (the published
/// files that we know miss by up to 3e-4 of the width).
inline constexpr double k_largest_miss = 3e-4;

/// How far a corner may lie off its plane because coordinates are rounded to doubles, and for no
/// other reason: four units in the last place of the largest. It matters far from the origin.
double coordinate_rounding(const Solid& solid);

const char* name_of(FaultKind kind);

}  // namespace culet
