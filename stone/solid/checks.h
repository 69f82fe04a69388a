#pragma once
// Finds what is wrong with a solid, in words. Side tests are exact (CGAL).

#include <string>
#include <vector>

#include "stone/solid/solid.h"

namespace culet {

enum class FaultKind {
    empty,
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
    self_crossing,
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
    /// Fraction of the diameter; more if the coordinates' own rounding exceeds it.
    double planarity = 1e-9;
    bool must_be_convex = true;
};

/// The worst kind first; empty for a sound solid. After twenty of a kind one line gives the number
/// of the others. Kinds that make no sense for so broken a solid are omitted (for example convexity
/// of an open surface).
std::vector<Fault> find_faults(const Solid& solid, const CheckLimits& limits = {});

/// True if each edge has two facets, in opposite directions, and each vertex one fan of facets.
/// Does not check the number of pieces or inside and outside.
bool is_closed(const Solid& solid);

/// True if closed, with convex outlines and no corner above a facet's plane, by exact orientation
/// of corners at any scale. A corner may be off by as much as this solid's corners are off their
/// own planes (`planarity`), at most `k_largest_miss` of the diameter: a design with near-miss
/// meets is convex, a fitted stone (planar to rounding) with a flipped edge is not.
bool is_convex(const Solid& solid);

/// The largest distance of a corner from the body of the facets' planes, which lies inside a closed
/// mesh: the error of drawing the stone as convex. Infinite when the planes bound no body.
double distance_from_planes_body(const Solid& solid);

/// By how much the meets of real cut designs miss, as a fraction of the diameter (published files:
/// up to 3e-4 of the width).
inline constexpr double k_largest_miss = 3e-4;

/// How far a corner may be off its plane by rounding to doubles: four units in the last place of
/// the largest coordinate. It matters far from the origin.
double coordinate_rounding(const Solid& solid);

const char* name_of(FaultKind kind);

}  // namespace culet
