#pragma once
// Line drawings of a stone: crown, pavilion and girdle views as a cutter draws them, without hidden
// lines, with colours and names of facets.

#include <string>
#include <vector>

#include "page/colour_maps.h"
#include "page/facet_view.h"
#include "stone/solid/solid.h"

namespace culet {

struct FacetPaint {
    std::string colour = "none";  ///< any SVG colour
    std::string about;            ///< one line, shown on pointing at the facet
    bool marked = false;          ///< outlined with dashes
};

struct PaintLegend {
    ColourMap map = ColourMap::residual;
    std::string what;  ///< the coloured quantity
    std::string from, middle, to;
    std::string mark;  ///< meaning of dashed outlines; empty: there are none
};

/// Index settings around a view from above or below.
struct IndexWheel {
    double gear = 0, offset = 0;  ///< as of Design; gear 0: none
};

/// The facets that face the viewer, 1000 units wide plus room for names beside it. `paint` has one
/// entry per facet, or is empty. Each facet is a focusable group titled with name and `about`.
/// Names are escaped. Empty when no facet faces the viewer.
std::string draw_facets_svg(const Solid& solid, ViewSide side,
                            const std::vector<FacetPaint>& paint = {},
                            const IndexWheel& wheel = {});

/// The three views with title and legend, as a self-contained SVG file.
std::string drawing_svg(const std::string& title, const std::string& subtitle, const Solid& solid,
                        const std::vector<FacetPaint>& paint, const PaintLegend& legend);

/// "Crown, from above", ...
const char* caption_of(ViewSide side);

}  // namespace culet
