#pragma once

#include <vector>

#include "stone/solid/solid.h"

namespace culet::test {

/// The solid that planes enclose. Corners that rounding split are joined again.
inline Solid enclosed(const std::vector<NamedPlane>& planes) {
    const HalfSpaceSolid cut = intersect_half_spaces(planes);
    return contract_near_meets(cut.solid, 1e-9 * diameter(cut.solid)).solid;
}

}  // namespace culet::test
