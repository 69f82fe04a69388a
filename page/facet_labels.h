#pragma once
// Places the names of facets in a drawing.

#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "page/facet_view.h"

namespace culet {

struct FacetLabel {
    int facet = 0;            ///< index in the solid
    std::string text;         ///< the name, shortened when it is very long
    glm::dvec2 at{0, 0};      ///< middle of the text; if `has_leader`: its end next to the drawing
    double size = 0;          ///< line height
    double turn_deg = 0;      ///< clockwise on the page
    bool has_leader = false;  ///< stands beside the drawing, with a leader line to the facet
    bool at_right = false;    ///< if `has_leader`
    glm::dvec2 foot{0, 0};    ///< where the leader ends, in the facet
};

struct FacetLabels {
    std::vector<FacetLabel> labels;
    double left = 0, right = 0;  ///< room that names with a leader need beside the drawing
};

/// A name stands in its facet, as large as fits, turned along it where that helps. If it would be
/// too small to read, it stands beside the drawing with a leader line; without room there (several
/// hundred facets) it is omitted.
FacetLabels place_labels(const Solid& solid, const FacetView& view);

}  // namespace culet
