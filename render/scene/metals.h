#pragma once
// The metals of jewellery, as a scene's `material = { kind = "metal", ... }` takes them.

#include <string_view>
#include <vector>

#include "render/scene/lights.h"

namespace culet {

/// `f0` is the reflectance at normal incidence in linear sRGB primaries: of gold, silver and
/// platinum as computed from measured n and k (Akenine-Moeller et al., Real-Time Rendering, 4th
/// ed., 2018, table 9.2).
///
/// No table of alloys was at hand, so theirs are estimates. Rose gold: gold, copper and silver of
/// that table, weighted by the atoms of an 18 carat alloy of 75 % gold, 20.5 % copper and 4.5 %
/// silver by weight. White gold: palladium of that table, the metal that whitens it.
struct Metal {
    const char* name;
    Rgb f0;
};

const std::vector<Metal>& metals();

/// Throws InputError with the nearest name.
const Metal& metal_named(std::string_view name);

}  // namespace culet
