#pragma once
// Where the names of facets stand in a drawing.

#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "page/facet_view.h"

namespace culet {

struct FacetLabel {
    int facet = 0;          ///< index in the solid
    std::string text;       ///< the name, shortened when it is very long
    glm::dvec2 at{0, 0};    ///< middle of the text; of a led one: its end next to the drawing
    double size = 0;        ///< height of the letters' line
    double turn_deg = 0;    ///< clockwise on the page
    bool led = false;       ///< stands beside the drawing, with a line to the facet
    bool at_right = false;  ///< of a led one
    glm::dvec2 foot{0, 0};  ///< where its line ends, in the facet
};

struct FacetLabels {
    std::vector<FacetLabel> labels;
    double left = 0, right = 0;  ///< room that led names take up beside the drawing
};

/// A name stands in its facet, as large as fits and turned along it where that helps, or, where it
/// would be too small to read, beside the drawing with a line to the facet. Names that find no room
/// there either are left out (several hundred facets).
FacetLabels place_labels(const Solid& solid, const FacetView& view);

}  // namespace culet
