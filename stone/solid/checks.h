#pragma once
// Finds what is wrong with a solid and says it in words. All decisions about sides use exact
// predicates (CGAL).

#include <string>
#include <vector>

#include "stone/solid/solid.h"

namespace culet {

enum class FaultKind {
    empty,             ///< no facets
    not_finite,        ///< a coordinate is NaN or infinite
    degenerate_facet,  ///< fewer than three distinct corners, or no area
    open,              ///< an edge with only one facet
    not_manifold,    ///< an edge with more than two facets, or a vertex whose facets are more than
                     ///< one fan
    misoriented,     ///< neighbouring facets run in the same direction along their edge
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
    /// As a fraction of the diameter. Where the coordinates are so large that their own rounding
    /// exceeds this, that much is allowed.
    double planarity = 1e-9;
    bool must_be_convex = true;
};

/// Faults, the worst kind first; empty for a sound solid. Only the first twenty of a kind are
/// listed; one more line gives the number of the others. Kinds that are meaningless for so broken a
/// solid are omitted (for example whether an open surface is convex).
std::vector<Fault> find_faults(const Solid& solid, const CheckLimits& limits = {});

/// True if each edge has two facets that run along it in opposite directions, and each vertex has
/// one fan of facets. Does not check the number of pieces or inside and outside.
bool is_closed(const Solid& solid);

/// True if closed, with convex outlines and no corner above a facet's plane. Uses the exact
/// orientation of corners, so it does not depend on scale. A corner may be off by as much as this
/// solid's corners are off their own facets' planes (`planarity`), at most `k_largest_miss` of the
/// diameter. So a design with near-miss meets is convex, and a fitted stone (planar to rounding)
/// with a flipped edge is not.
bool is_convex(const Solid& solid);

/// The largest distance of a corner from the body bounded by the facets' planes, which lies inside
/// a closed mesh. It says how wrong the body is that is drawn when a stone is treated as convex.
/// Infinite when the planes bound no body.
double distance_from_planes_body(const Solid& solid);

/// By how much the meets of real cut designs miss, as a fraction of the diameter. The published
/// files that we know miss by up to 3e-4 of the width.
inline constexpr double k_largest_miss = 3e-4;

/// How far a corner may lie off its plane merely because coordinates are doubles: four units in the
/// last place of the largest. It matters far from the origin.
double coordinate_rounding(const Solid& solid);

const char* name_of(FaultKind kind);

}  // namespace culet
