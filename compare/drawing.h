#pragma once
// A stone as a line drawing: its facets seen along the axis, each filled with a colour.

#include <string>
#include <vector>

#include "stone/solid.h"

namespace culet {

enum class ViewSide {
    crown,    ///< from +z: x to the right, y up
    pavilion  ///< from -z, the stone turned over about y: x to the left, y up
};

struct FacetPaint {
    std::string colour = "none";  ///< anything CSS knows
    std::string about;            ///< one line for the reader who points at the facet
};

/// SVG of the facets that face the viewer, in an orthographic projection that fills the drawing.
/// `paint` has one entry a facet of the solid, or is empty. Each facet is a focusable group with
/// its name and `about` as its title; names are written where there is room. Names are escaped. An
/// empty string when no facet faces the viewer.
std::string draw_facets_svg(const Solid& solid, ViewSide side,
                            const std::vector<FacetPaint>& paint = {});

}  // namespace culet
