#pragma once
// A fit as part of a page, from its JSON report: verdict, what to look at, drawing and proportions;
// the rest is collapsed. Parts are empty if the report has nothing for them, and throw InputError
// when it is not a JSON object.

#include <optional>
#include <string>
#include <vector>

#include "stone/solid/solid.h"

namespace culet {

struct FitView {
    std::string fit_json;  ///< as written by `culet fit --report`
    std::optional<Solid> fitted;
    std::string length_unit = "mm";
};

/// A word, a symbol, and a sentence or two.
std::string fit_card(const FitView& view);
/// Numbers of readings and facets, and uncertainties: `<div>`s of a list of tiles.
std::string fit_tiles(const FitView& view);
/// Suspects with advice, outliers of tiers, what is undetermined, and what to read next.
std::string fit_look_section(const FitView& view);
/// The stone coloured by its readings and by its uncertainty; `fold`: collapsed, for pages that
/// show another picture.
std::string fit_drawing_section(const FitView& view, bool fold);
/// The proportions that people ask for first, with calipers beside the diameter; the others are
/// collapsed.
std::string fit_proportions_section(const FitView& view);
/// All the rest, collapsed.
std::string fit_section(const FitView& view);

/// Facets are coloured by how much steeper (red) or flatter (blue) they became.
std::string change_drawings(const Solid& before, const Solid& after);
std::string changes_table(const Solid& before, const Solid& after, const std::string& length_unit);

/// The views of a stone side by side; facets can be pointed at.
struct FacetPaint;
std::string stone_views(const Solid& solid, const std::vector<FacetPaint>& paint);

}  // namespace culet
