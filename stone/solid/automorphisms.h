#pragma once
// In how many ways a solid's facets, edges and corners may be exchanged so that who meets whom
// stays the same. Purely combinatorial and exact: no length, no angle and no tolerance plays a
// part, so that the answer is the same for a rough mesh and for a perfect stone.

#include <vector>

#include "stone/solid/solid.h"

namespace culet {

/// facets[f] and vertices[v] are where facet f and vertex v go.
struct Automorphism {
    std::vector<int> facets, vertices;
    bool turns_over = false;  ///< a mirroring: loops that ran counter-clockwise run clockwise

    bool operator==(const Automorphism&) const = default;
};

/// All of them, the identity first, then in the order of the images of one edge. The surface must
/// be closed (InternalError, see `find_faults`); of several pieces only the identity is given. Each
/// is found by following the neighbours of one edge's image all over the surface (flag propagation;
/// the map of a connected surface is fixed by the image of one flag), so there are at most 4 for
/// each edge. Cost: edges x edges of the rarest shape of neighbourhood, at worst.
std::vector<Automorphism> automorphisms(const Solid& solid);

/// Those of `all` that leave facet `pole` where it is: turns about it and mirrorings through it.
std::vector<Automorphism> that_keep(const std::vector<Automorphism>& all, int pole);

/// first, then second.
Automorphism followed_by(const Automorphism& first, const Automorphism& second);

/// How often it must be repeated until everything is back in its place.
int order_of(const Automorphism& automorphism);

/// By how many of its own corners facet `pole`, which stays in its place, is turned
/// counter-clockwise; its corner 0 goes to corner `steps`. Of n corners that is steps / n of a full
/// turn, if the turned stone looks as before.
int steps_of_turn(const Solid& solid, int pole, const Automorphism& automorphism);

/// The facets that the maps take into each other, each orbit in the order in which repeated
/// maps reach its members, orbits by their lowest facet.
std::vector<std::vector<int>> facet_orbits(const std::vector<Automorphism>& group,
                                           std::size_t facets);

}  // namespace culet
