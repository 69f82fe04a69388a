#pragma once
// The tiers of a stone as a cutter speaks of them: table, mains, halves, stars, girdle.

#include <string>
#include <string_view>
#include <vector>

#include "stone/solid/solid.h"

namespace culet {

/// Level within 7 degrees and the largest such facet that looks up: table; such facets that look
/// down: culet. Upright within 10 degrees: girdle.
enum class StonePart { table, crown, girdle, pavilion, culet };

StonePart part_of(const Solid& solid, int facet, int table, const Vec3& up);

/// The table, or -1.
int table_facet(const Solid& solid, const Vec3& up);

/// Facets that reach from the girdle to the table (crown), or to the lowest corner or the culet
/// (pavilion); where none does, those of the tier with the largest area. In the solid's order.
std::vector<int> main_facets(const Solid& solid, const Vec3& up, bool crown);

/// Facets of one tier of the solid's design (design.h), where it has one with all its facets. Else
/// those of one part that belong together by the drawing itself: the symmetry about up that the
/// drawing has takes them into each other (drawn_symmetry.h), or they have the same angle (to 0.02
/// degrees, as designs are written) and distance, or name, or they have one name and the drawing
/// comes near to a symmetry that takes them into each other. Names alone make no tier; they part
/// one where they differ (see `tier_names_of`).
struct FacetTier {
    StonePart part = StonePart::crown;
    std::string name;  ///< see `tier_names_of`; empty: they have none in common
    std::vector<int> facets;
    double inclination = 0;  ///< mean, radians, 0 level .. pi/2 upright
    double scatter = 0;      ///< by how much the drawing is off an inclination, one sigma, radians
    std::string pattern;     ///< that matches these facets and no others (`C*`, `A.*`); or empty
};

/// In the order of their first facets.
std::vector<FacetTier> tiers_of(const Solid& solid, const Vec3& up);

/// Of each of so many facets the index of its tier, whose `facets` list it; -1: it is of none.
template <class Tier>
std::vector<int> tier_of_each(const std::vector<Tier>& tiers, std::size_t facets) {
    std::vector<int> tier_of(facets, -1);
    for (std::size_t t = 0; t < tiers.size(); ++t) {
        for (const int f : tiers[t].facets) tier_of[std::size_t(f)] = int(t);
    }
    return tier_of;
}

/// What each facet's name has in common with those of its tier: `C` of C1; `A` of A.1, and of A
/// where there is an A.1; `C1` of C1NE and `G` of GNE; nothing of f12, and of what facets above the
/// girdle and below it have in common: an exporter's numbers.
std::vector<std::string> tier_names_of(const Solid& solid, const Vec3& up);

/// `*` stands for any run of characters. `A.*` means the tier A of a cut design: A itself too,
/// besides A.1, A.2, ...
bool name_matches(std::string_view pattern, std::string_view name);

}  // namespace culet
