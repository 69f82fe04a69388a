#pragma once
// The metals of jewellery that scenes name in `material = { kind = "metal", ... }`.

#include <string_view>
#include <vector>

#include "render/scene/lights.h"

namespace culet {

/// `f0`: reflectance at normal incidence, in linear sRGB primaries. Gold, silver and platinum are
/// computed from measured n and k (Akenine-Moeller et al., Real-Time Rendering, 4th ed., 2018,
/// table 9.2).
///
/// The alloys are estimates, for lack of a table. Rose gold: the table's gold, copper and silver,
/// weighted by atoms of an 18 carat alloy (by weight 75 % gold, 20.5 % copper, 4.5 % silver). White
/// gold: the table's palladium, the metal that whitens it.
struct Metal {
    const char* name;
    Rgb f0;
};

const std::vector<Metal>& metals();

/// Throws InputError that suggests the nearest name.
const Metal& metal_named(std::string_view name);

}  // namespace culet
