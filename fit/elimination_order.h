#pragma once
// In which order the unknowns and equations of a saddle system are eliminated. Private to the room.
//
//     [ P  J' ]
//     [ J  -C ]    P: of the unknowns, J: a row for each equation, C: its variance
//
// Unknowns of one facet or point go together. Soft equations of few facets and points are folded
// into P as J'J / C and never eliminated. Sharp ones (J'J / C would drown P) and those of many
// facets have a place of their own. All are ordered by approximate minimum degree (Amestoy, Davis &
// Duff 1996) on the graph of who shares an equation with whom.

#include <vector>

#include "fit/fronts.h"
#include "fit/sparse_rows.h"

namespace culet {

struct EliminationOrder {
    std::vector<char> is_folded;  ///< of each equation
    /// Unknowns are 0 .. unknowns - 1, equation i is unknowns + i; folded ones are in none.
    IndexLists blocks, cliques;
    int eliminated = 0;  ///< equations that are not folded
};

/// How sharp an equation is: the square of its largest slope over its variance.
bool is_sharp(const SparseRows& rows, int equation);

/// `entries`: of P, those beside its diagonal. `folded`: how many equations, from the first, are
/// folded whatever they are, and no others; negative: as they are.
EliminationOrder elimination_order(const SparseRows& rows, int unknowns,
                                   const std::vector<SymmetricEntry>& entries, int folded = -1);

}  // namespace culet
