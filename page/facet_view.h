#pragma once
// A stone seen from one side: the facets that face the viewer, and their places in the picture.

#include <glm/vec2.hpp>
#include <vector>

#include "stone/solid/solid.h"

namespace culet {

enum class ViewSide {
    crown,     ///< from +z: x to the right, y up
    pavilion,  ///< from -z, the stone turned over about y: x to the left, y up
    girdle     ///< from -y: x to the right, z up
};

struct SeenFacet {
    int facet = 0;  ///< index in the solid
    std::vector<glm::dvec2> corners;
};

/// x runs to the right and y downwards.
struct FacetView {
    std::vector<SeenFacet> facets;  ///< what is farther away first
    double width = 0, height = 0;
    double scale = 0;         ///< picture units per unit of the solid
    glm::dvec2 origin{0, 0};  ///< position of the solid's origin
};

/// Orthographic projection of the facets that face the viewer; the longer side is `size` minus a
/// small margin. Omits facets seen at less than half a degree, which are lines, and corners that
/// are not finite. Facets of a convex solid do not overlap; others are sorted by mean depth, and
/// nearer ones cover what lies behind. Empty when no facet faces the viewer.
FacetView view_of(const Solid& solid, ViewSide side, double size);

}  // namespace culet
