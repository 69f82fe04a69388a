#pragma once
// A cut design as its author gives it: tiers in cutting order with angle, index settings and
// instruction. A solid finds its facets in its design by name, so a fitted, recut or converted
// stone keeps the tier and index of every facet.

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "stone/solid/solid.h"

namespace culet {

/// Where a facet is cut. Angle from the horizontal: 0 table, 90 girdle, positive on both sides.
struct CutSetting {
    double angle_deg = 0;
    bool pavilion = false;
    double distance = 0;  ///< from the origin, >= 0
    double index = 0;     ///< on the gear; may be fractional
};

struct DesignFacet {
    double index = 0;   ///< as given
    std::string label;  ///< written beside it; empty: none
    std::string facet;  ///< name in the solid; empty: it bounds nothing, or repeats an earlier one
};

struct DesignTier {
    CutSetting setting;       ///< of all its facets, except for the index
    std::string instruction;  ///< such as "Meet 1-2-G1"; empty: none
    std::vector<DesignFacet> facets;
    double frosting = 0;  ///< 0: polished; Gem Cut Studio writes 0.5. Only its files hold it
    bool hidden = false;  ///< only in the design: not cut. Likewise
    bool guide = false;   ///< Gem Cut Studio's mark, which changes no shape. Likewise
};

struct Design {
    double gear = 96;            ///< index teeth; negative: they count the other way round
    bool gear_supposed = false;  ///< the file does not state it
    double gear_offset = 0;
    int symmetry = 1;
    bool mirror = false;
    std::optional<double> refractive_index;
    std::vector<std::string> headings, footnotes;
    std::vector<DesignTier> tiers;  ///< in the order of cutting
    /// What else a .gcs says, by element and attribute: `render.material`. Written back to .gcs.
    std::map<std::string, std::string> studio;
};

/// n = (sin a sin t, sin a cos t, +-cos a) with t = 2 pi (index - offset) / gear. Exact at whole
/// quarters, so that a girdle stands upright and a table lies flat.
Plane plane_of(const CutSetting& setting, const Design& design);

/// The inverse; the index lies in (0, |gear|].
CutSetting setting_of(const Plane& plane, const Design& design);

struct DesignPlace {
    int tier = -1, facet = -1;  ///< of the design; -1: it does not have the facet
};

/// One place for each facet of the solid.
std::vector<DesignPlace> places_of(const Solid& solid);

/// A cutter's names of the tiers: the tier's one label; else what its labels have in common, if no
/// other tier shares that; else the first label. Tiers without labels are P1, G1, C1, ... by side.
std::vector<std::string> tier_titles(const Design& design);

/// One for each facet of the solid: whether its tier is frosted (ground, not polished). Empty where
/// none is.
std::vector<bool> ground_facets(const Solid& solid);
/// "C1, C2": titles of the frosted tiers that are cut; empty: none.
std::string frosted_tiers(const Design& design);
std::string frosted_tiers(const Solid& solid);

/// The design that a mesh shows: its tiers (tiers.h) with pavilion before girdle before crown, the
/// steepest first, their symmetry, and index settings on a wheel of 96 teeth. z is up.
Design drawn_design(const Solid& solid);

Design cutting_design(const Solid& solid);

/// Joins facets that a file gives one by one because each has its own angle (a fitted stone), if
/// their names share a stem (`C` of C1, `A` of A.1) and the drawing has them in one tier. The tier
/// gets their mean angle and distance.
void join_split_tiers(const Solid& solid, Design& design);

/// Writes lines of GemCad's .asc that hold the facets' names too, and reads them. Throws
/// InputError.
std::string design_text(const Design& design);
Design design_in(std::string_view text);

}  // namespace culet
