#pragma once
// A fit as part of a page, from its JSON report: the verdict, what to look at, the drawing, the
// proportions, and everything else behind lines to click. Each part is empty where the report has
// nothing for it, and throws InputError when the report is no JSON object.

#include <optional>
#include <string>
#include <vector>

#include "stone/solid/solid.h"

namespace culet {

struct FitView {
    std::string fit_json;         ///< as written by `culet fit --report`
    std::optional<Solid> fitted;  ///< drawn
    std::string length_unit = "mm";
};

/// A word, a sign, and a sentence or two.
std::string fit_card(const FitView& view);
/// How many readings and facets, how sure: `<div>`s of a list of tiles.
std::string fit_tiles(const FitView& view);
/// Suspects with what to do about them; what stands out; what is open; what to read next.
std::string fit_look_section(const FitView& view);
/// The views of the stone by its readings and by its uncertainty; `fold`: where a page has another
/// picture.
std::string fit_drawing_section(const FitView& view, bool fold);
/// The proportions that people ask for first, calipers beside the diameter; the others folded.
std::string fit_proportions_section(const FitView& view);
/// Everything else, folded.
std::string fit_section(const FitView& view);

/// The fitted stone, each facet coloured by how much steeper (red) or flatter (blue) it became.
std::string change_drawings(const Solid& before, const Solid& after);
/// Each facet before and after.
std::string changes_table(const Solid& before, const Solid& after, const std::string& length_unit);

/// The views of a stone side by side; facets can be pointed at.
struct FacetPaint;
std::string stone_views(const Solid& solid, const std::vector<FacetPaint>& paint);

}  // namespace culet
