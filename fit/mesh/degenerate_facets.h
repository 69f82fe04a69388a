#pragma once
// Which parts of a stone whose facets and meets could not be brought together stand in the way.
// Private to the room.

#include <string>
#include <vector>

#include "stone/solid/solid.h"

namespace culet {

/// By name, in the solid's order.
struct ComeToNothing {
    std::vector<std::string> facets;  ///< narrower than a hundred-thousandth of the diameter
    /// `A|B`: neighbours within 0.001 degrees of one plane, which have no edge.
    std::vector<std::string> edges;
};
ComeToNothing degenerate_facets(const Solid& solid);

}  // namespace culet
