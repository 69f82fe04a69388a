#pragma once
// The combinatorial symmetries of a solid: permutations of facets, edges and corners that keep
// neighbours. No length, angle or tolerance enters, so a rough mesh and a perfect stone give the
// same answer.

#include <vector>

#include "stone/solid/solid.h"

namespace culet {

/// Facet f goes to facets[f], vertex v to vertices[v].
struct Automorphism {
    std::vector<int> facets, vertices;
    bool turns_over = false;  ///< a mirroring: counter-clockwise loops become clockwise

    bool operator==(const Automorphism&) const = default;
};

/// The identity first, then in the order of the images of one edge. The surface must be closed
/// (InternalError, see `find_faults`); several pieces give only the identity. Found by following
/// the neighbours of one edge's image over the surface (flag propagation: the image of one flag
/// fixes the map), so there are at most 4 per edge. Worst case: edges x edges with the rarest
/// neighbourhood.
std::vector<Automorphism> automorphisms(const Solid& solid);

/// Those of `all` that keep facet `pole` in place: turns about it and mirrorings through it.
std::vector<Automorphism> that_keep(const std::vector<Automorphism>& all, int pole);

/// Applies first, then second.
Automorphism followed_by(const Automorphism& first, const Automorphism& second);

int order_of(const Automorphism& automorphism);

/// The number of corners by which facet `pole`, which stays in place, is turned counter-clockwise:
/// corner 0 goes to corner `steps`.
int steps_of_turn(const Solid& solid, int pole, const Automorphism& automorphism);

/// Members are in the order in which repeated maps reach them, orbits in the order of their lowest
/// facet.
std::vector<std::vector<int>> facet_orbits(const std::vector<Automorphism>& group,
                                           std::size_t facets);

}  // namespace culet
