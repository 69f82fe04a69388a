#pragma once
// Finds the degenerate parts of a stone whose facets and meets could not be reconciled. Private to
// the room.

#include <string>
#include <vector>

#include "stone/solid/solid.h"

namespace culet {

/// Names, in the solid's order.
struct DegenerateParts {
    std::vector<std::string> facets;  ///< narrower than 1e-5 of the diameter
    /// `A|B`: neighbours within 0.001 degrees of one plane, whose edge is undefined.
    std::vector<std::string> edges;
};
DegenerateParts degenerate_parts(const Solid& solid);

}  // namespace culet
