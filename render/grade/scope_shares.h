#pragma once
// What the trade's scopes show, as numbers: the parts of the eye's light that leave into bands of
// directions, those of the lights of the same names (scene/light_presets.h).

#include <array>

#include "render/grade/eye_light.h"

namespace culet {

/// Bands of directions, by angle to the scope's axis.
enum class ScopeBand { eye, inner, middle, rim, below };
constexpr int k_scope_band_count = 5;
using BandShares = std::array<double, k_scope_band_count>;

/// Increasing half angles that separate the bands, radians; `below` begins at 90 degrees.
struct ScopeBands {
    double eye = 0, inner = 0, middle = 0;
    ScopeBand of(double cosine) const;
};
ScopeBands aset_bands();
/// The reflector of ideal-scope and arrows, or if `hearts`, of the hearts scope. `inner` and
/// `middle` together are the reflector.
ScopeBands reflector_bands(bool hearts = false);

/// AGS's Angular Spectrum Evaluation Tool: parts of the eye's light that come from each colour;
/// they sum to 1.
struct AsetShares {
    double red = 0, green = 0, blue = 0;
    double dark = 0;  ///< from below, or not followed to the end
};
/// `facet`: only what is seen through it, e.g. the table; -1: the whole stone. Includes the outer
/// reflection, as in the instrument. `bands`: other limits than AGS's, as some programs use.
AsetShares aset_shares(const EyeLight& light, int facet = -1,
                       const ScopeBands& bands = aset_bands());

/// Light that enters and exits through the table, reflected by two pavilion facets. Its colour in
/// ASET indicates the pavilion's angle.
struct TableReflection {
    double share = 0;         ///< of the light on the table
    double elevation = 0;     ///< elevation at which its largest part exits, radians
    const char* colour = "";  ///< red, green, blue or dark
};
TableReflection table_reflection(const EyeLight& light, int table);

struct ScopeShares {
    double red = 0;    ///< from the reflector
    double dark = 0;   ///< from the eye's hole, from beyond the reflector's rim, or not followed to
                       ///< the end
    double white = 0;  ///< leakage: from below
};
ScopeShares ideal_scope_shares(const EyeLight& light);

/// Part from the dark field's ring of light below the stone: windows and leaks.
double dark_field_share(const EyeLight& light);

}  // namespace culet
