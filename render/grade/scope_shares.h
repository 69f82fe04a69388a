#pragma once
// What the trade's scopes see, as numbers: which part of the eye's light leaves into which band of
// directions. The bands are those of the lights by the same names (scene/light_presets.h).

#include <array>

#include "render/grade/eye_light.h"

namespace culet {

/// Bands of directions, by angle to the scope's axis.
enum class ScopeBand { eye, inner, middle, rim, below };
constexpr int k_scope_band_count = 5;
using BandShares = std::array<double, k_scope_band_count>;

/// Half angles where one band ends and the next begins, radians, growing; `below` begins at 90
/// degrees.
struct ScopeBands {
    double eye = 0, inner = 0, middle = 0;
    ScopeBand of(double cosine) const;
};
ScopeBands aset_bands();
/// The reflector of ideal-scope and arrows; `hearts`: of the hearts' scope. `inner` and `middle`
/// together are the reflector.
ScopeBands reflector_bands(bool hearts = false);

/// AGS's Angular Spectrum Evaluation Tool: shares of the eye's light that come from each colour;
/// they sum to 1.
struct AsetShares {
    double red = 0, green = 0, blue = 0;
    double dark = 0;  ///< from below, or not followed to the end
};
/// `table`: a facet, for what is seen through it alone; -1: the whole stone. The reflection of the
/// outside counts, as in the instrument. `bands`: others than AGS's, for what other programs draw.
AsetShares aset_shares(const EyeLight& light, int facet = -1,
                       const ScopeBands& bands = aset_bands());

/// Light that goes in through the table, is reflected by two facets of the pavilion and comes out
/// through the table again: the table's reflection, whose colour in ASET tells a pavilion's angle.
struct TableReflection {
    double share = 0;         ///< of the light on the table
    double elevation = 0;     ///< that its largest share leaves under, radians
    const char* colour = "";  ///< red, green, blue or dark
};
TableReflection table_reflection(const EyeLight& light, int table);

struct ScopeShares {
    double red = 0;    ///< from the reflector
    double dark = 0;   ///< from the eye's hole and beyond the reflector's rim, or not followed
    double white = 0;  ///< leaks: from below
};
ScopeShares ideal_scope_shares(const EyeLight& light);

/// Share from the dark field's ring of light below the stone: windows and leaks.
double dark_field_share(const EyeLight& light);

}  // namespace culet
