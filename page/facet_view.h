#pragma once
// A stone seen from one side: which facets face the viewer, and where they lie in the picture.

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

/// In the picture x runs to the right and y downwards.
struct FacetView {
    std::vector<SeenFacet> facets;  ///< what is farther away first
    double width = 0, height = 0;
    double scale = 0;         ///< picture units for one unit of the solid
    glm::dvec2 origin{0, 0};  ///< where the solid's origin lies
};

/// Orthographic projection of the facets that face the viewer, its longer side `size` less a small
/// margin. Facets seen at under half a degree are lines and are left out; so are corners that are
/// not finite. Of convex solids no two facets overlap; of others the nearer ones come later and
/// cover what lies behind them, by their mean depth. Empty when nothing faces the viewer.
FacetView view_of(const Solid& solid, ViewSide side, double size);

}  // namespace culet
