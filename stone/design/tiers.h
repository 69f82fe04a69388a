#pragma once
// The tiers of a stone as a cutter speaks of them: table, mains, halves, stars, girdle.

#include <string>
#include <string_view>
#include <vector>

#include "stone/solid/solid.h"

namespace culet {

/// Table: the largest facet that faces up and is level within 7 degrees. Culet: facets that face
/// down and are as level. Girdle: upright within 10 degrees.
enum class StonePart { table, crown, girdle, pavilion, culet };

StonePart part_of(const Solid& solid, int facet, int table, const Vec3& up);

/// Returns -1 without a table.
int table_facet(const Solid& solid, const Vec3& up);

/// Facets that reach from the girdle to the table (crown), or to the lowest corner or the culet
/// (pavilion); where none does, the tier with the largest area. In the solid's order.
std::vector<int> main_facets(const Solid& solid, const Vec3& up, bool crown);

/// Facets of one tier: of the solid's design (design.h), if it lists all facets. Otherwise facets
/// of one part that the drawing itself puts together:
/// - the drawing's symmetry about up maps them into each other (drawn_symmetry.h), or
/// - they share the angle (to 0.02 degrees, as designs are written) and the distance, or the name,
///   or
/// - they share a name and the drawing comes near to a symmetry that maps them into each other.
/// Names alone make no tier, but different names split one (see `tier_names_of`).
struct FacetTier {
    StonePart part = StonePart::crown;
    std::string name;  ///< see `tier_names_of`; empty: they share none
    std::vector<int> facets;
    double inclination = 0;  ///< mean, radians, 0 level .. pi/2 upright
    double scatter = 0;      ///< the drawing's error of one inclination, one sigma, radians
    std::string pattern;     ///< matches these facets and no others (`C*`, `A.*`); may be empty
};

std::vector<FacetTier> tiers_of(const Solid& solid, const Vec3& up);

/// For each facet the index of the tier that lists it; -1: none does.
template <class Tier>
std::vector<int> tier_of_each(const std::vector<Tier>& tiers, std::size_t facets) {
    std::vector<int> tier_of(facets, -1);
    for (std::size_t t = 0; t < tiers.size(); ++t) {
        for (const int f : tiers[t].facets) tier_of[std::size_t(f)] = int(t);
    }
    return tier_of;
}

/// What each facet's name has in common with its tier's: `C` for C1; `A` for A.1, and for A where
/// there is an A.1; `C1` for C1NE and `G` for GNE. Empty for f12, and for what facets above and
/// below the girdle share, which are an exporter's numbers.
std::vector<std::string> tier_names_of(const Solid& solid, const Vec3& up);

/// `*` matches any run of characters. `A.*` means the tier A of a cut design: A itself, A.1, A.2,
/// ...
bool name_matches(std::string_view pattern, std::string_view name);

}  // namespace culet
