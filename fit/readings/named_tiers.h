#pragma once
// Tiers (stone/design/tiers.h) as the readings of a stone are told by.

#include <string>
#include <vector>

#include "stone/solid/solid.h"

namespace culet {

struct NamedTier {
    std::string name;   ///< `C*` where a name has this tier alone; else its first and last facet
    std::string words;  ///< in the trade's words, plural: `crown mains`, `facets of tier A*`;
                        ///< with the angle where a name has several: `stars of 24.7 degrees`
    std::vector<int> facets;  ///< of the solid, in its order; two or more
    double scatter = 0;       ///< as of FacetTier
    bool named = false;       ///< a name in common confirms it
};

/// A facet is in one tier at most. `up` is a unit vector.
std::vector<NamedTier> named_tiers(const Solid& solid, const Vec3& up);

}  // namespace culet
