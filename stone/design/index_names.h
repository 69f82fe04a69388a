#pragma once
// Facets as a cutter calls them, by tier and index setting: `A@76`. Unlike 1.10, no spreadsheet
// takes that for a number, and it tells which facet is meant.

#include <string>
#include <string_view>
#include <vector>

#include "stone/solid/solid.h"

namespace culet {

/// Each facet's tooth of the index wheel, in (0, gear], to a hundredth: by the solid's design
/// (design.h), or by azimuth for another wheel or without a design. Empty ("") for level facets and
/// for gear 0 (unknown wheel).
std::vector<std::string> index_teeth(const Solid& solid, double gear);

/// `A@76` for a facet of tier A (`tier_titles`) on a wheel of 96 teeth; `A@12of64` on another. The
/// facet's own name if it has no tier, lies level, or would share its index name.
std::vector<std::string> index_names(const Solid& solid, double gear);

/// The facets of this tier, or of this name, within half a tooth of the index. Empty: none, or
/// `name` has no @.
std::vector<int> facets_at_index(const Solid& solid, std::string_view name);

}  // namespace culet
