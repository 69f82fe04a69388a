#pragma once
// Facets as a cutter calls them: by tier and index setting, `A@76`. No spreadsheet takes that for a
// number, as it does 1.10, and it tells which facet is meant.

#include <string>
#include <string_view>
#include <vector>

#include "stone/solid/solid.h"

namespace culet {

/// Of each facet the tooth of the index wheel under it, in (0, gear], as the solid's design has it
/// (design.h); on another wheel, or without a design, as the facet stands. Nothing ("") of what
/// lies level, and on a wheel of no teeth (0), which stands for one that nobody knows. To a
/// hundredth of a tooth.
std::vector<std::string> index_teeth(const Solid& solid, double gear);

/// `A@76` of a facet of the tier A (`tier_titles`) of the solid's design, on a wheel of 96 teeth;
/// `A@12of64` on another. The facet's own name where it is of no tier, lies level, or where another
/// facet would get the same name.
std::vector<std::string> index_names(const Solid& solid, double gear);

/// The facets that such a name means: of this tier, or of this name, within half a tooth of the
/// index. Empty: none. `name` without an @ means none.
std::vector<int> facets_at_index(const Solid& solid, std::string_view name);

}  // namespace culet
