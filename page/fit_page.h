#pragma once
// A fit as part of a page, from its JSON report.

#include <optional>
#include <string>

#include "stone/solid.h"

namespace culet {

struct FitView {
    std::string fit_json;         ///< as written by `culet fit --report`
    std::optional<Solid> fitted;  ///< drawn
    std::string length_unit = "mm";
};

/// "The fitted stone": status, drawings, readings, facets. Empty without report and solid. Throws
/// InputError when the report is no JSON object.
std::string fit_section(const FitView& view);

/// The fitted stone, each facet coloured by how much steeper (red) or flatter (blue) it became.
std::string change_drawings(const Solid& before, const Solid& after);
/// Each facet before and after.
std::string changes_table(const Solid& before, const Solid& after, const std::string& length_unit);

/// The views of a stone side by side; facets can be pointed at.
struct FacetPaint;
std::string stone_views(const Solid& solid, const std::vector<FacetPaint>& paint);

}  // namespace culet
