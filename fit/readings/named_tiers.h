#pragma once
// Tiers as the readings of a stone are told by: all facets of one side and one name, also where a
// design gives them several angles (an oval's mains); without names, those of one angle.

#include <string>
#include <vector>

#include "stone/solid.h"

namespace culet {

struct NamedTier {
    std::string name;         ///< `C*` where the tier has a name; else its first and last facet
    std::string words;        ///< in the trade's words, plural: `crown mains`, `facets of tier A*`
    std::vector<int> facets;  ///< of the solid, in its order; two or more
};

/// A facet is in one tier at most. `up` is a unit vector.
std::vector<NamedTier> named_tiers(const Solid& solid, const Vec3& up);

}  // namespace culet
