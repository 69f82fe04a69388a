#pragma once
// Tiers as a cutter names them: facets cut at one setting of the angle, told by their names (C1,
// C2, ...; GemCad's A, A.1, ...) and, where names say nothing, by their angles in the mesh.

#include <string>
#include <vector>

#include "stone/solid.h"

namespace culet {

struct NamedTier {
    std::string name;    ///< `C*` where that pattern matches these facets and no other, or `C1..C8`
    std::string words;   ///< in the trade's words, plural: `crown mains`, `facets of tier A`
    std::vector<int> facets;  ///< of the solid, in its order; two or more
};

/// A facet is in one tier at most. `up` is a unit vector.
std::vector<NamedTier> named_tiers(const Solid& solid, const Vec3& up);

/// The letters of a facet's name: without the digits (and points) at its end.
std::string name_stem(const std::string& name);

}  // namespace culet
