#pragma once
// Small moves of a convex stone's planes: each facet turns about two axes through its middle, and
// shifts along its normal.

#include <optional>
#include <vector>

#include "stone/solid/solid.h"

namespace culet {

constexpr std::size_t k_moves_of_a_facet = 3;

/// Reference frame of a facet's moves. Turns are radians about `u` and `v`; a shift is a length
/// over `reach`, so that all three change a picture about equally.
struct FacetMoves {
    Vec3 middle{0}, u{1, 0, 0}, v{0, 1, 0}, normal{0, 0, 1};
    double reach = 1;  ///< a quarter of the stone's diameter
};
std::vector<FacetMoves> moves_of(const Solid& solid);

/// The facet's plane after one of its moves (0 and 1: turns, 2: the shift).
Plane moved_plane(const FacetMoves& facet, std::size_t move, double amount);

/// The stone with one plane moved; nothing when the planes no longer enclose a solid.
std::optional<Solid> with_plane_moved(const Solid& solid, std::size_t facet, const FacetMoves& from,
                                      std::size_t move, double amount);

/// The moves (three per facet), to first order, from each facet of `from` to the plane of the same
/// name. Zero where `to` has none.
std::vector<double> moves_between(const Solid& from, const Solid& to);

/// The moves (three per facet) for a unit of shift along x, y, z, of rotation about them (through
/// the middle), and of scale, of the whole stone.
std::vector<std::vector<double>> moves_of_the_whole(const Solid& solid);

/// The number changes by normal . dn + offset * dd.
struct PlaneSlopes {
    Vec3 normal{0};
    double offset = 0;
};
PlaneSlopes plane_slopes(const FacetMoves& facet, double by_u, double by_v, double by_shift);

}  // namespace culet
