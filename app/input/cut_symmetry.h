#pragma once
// The symmetry of the cut that a stone is said to have.

#include <string>

#include "refine/spin/repeated_facets.h"

namespace culet {

struct GivenCut {
    CutSymmetry symmetry;
    bool convex = true;
};

/// `cut`: the name of a standard cut, or a mesh or design, upright. Throws InputError if it repeats
/// no facet about its axis.
GivenCut given_cut(const std::string& cut);

/// "4 times around the axis and mirrored"
std::string words_of(const CutSymmetry& symmetry);

}  // namespace culet
