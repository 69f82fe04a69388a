#pragma once
// A stone as a line drawing: crown, pavilion and girdle views as a cutter draws them, hidden lines
// left out, each facet filled with a colour and named.

#include <string>
#include <vector>

#include "page/colour_maps.h"
#include "page/facet_view.h"
#include "stone/solid/solid.h"

namespace culet {

struct FacetPaint {
    std::string colour = "none";  ///< anything SVG knows
    std::string about;            ///< one line for the reader who points at the facet
    bool marked = false;          ///< outlined with dashes
};

/// What the colours say.
struct PaintLegend {
    ColourMap map = ColourMap::residual;
    std::string what;  ///< of the colours
    std::string from, middle, to;
    std::string mark;  ///< of dashed outlines; empty: there are none
};

/// Index settings round a view from above or below.
struct IndexWheel {
    double gear = 0, offset = 0;  ///< as of Design; gear 0: none
};

/// SVG of the facets that face the viewer, 1000 units across and what names beside it need. `paint`
/// has one entry a facet of the solid, or is empty. Each facet is a focusable group with its name
/// and `about` as its title. Names are escaped. An empty string when no facet faces the viewer.
std::string draw_facets_svg(const Solid& solid, ViewSide side,
                            const std::vector<FacetPaint>& paint = {},
                            const IndexWheel& wheel = {});

/// The three views on one sheet with title and legend: an SVG file of its own.
std::string drawing_svg(const std::string& title, const std::string& subtitle, const Solid& solid,
                        const std::vector<FacetPaint>& paint, const PaintLegend& legend);

/// "Crown, from above", ...
const char* caption_of(ViewSide side);

}  // namespace culet
