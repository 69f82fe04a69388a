#pragma once
// A cut design as its author gives it: tiers in the order of cutting, each with its angle, index
// settings and instruction. A solid knows the design that it was cut by, and its facets are found
// in it by their names: so a fitted, recut or converted stone keeps tier and index of every facet.

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "stone/solid/solid.h"

namespace culet {

/// Where a facet is cut. Angle from the horizontal: 0 table, 90 girdle, both sides positive.
struct CutSetting {
    double angle_deg = 0;
    bool pavilion = false;
    double distance = 0;  ///< from the origin, >= 0
    double index = 0;     ///< on the gear; may be fractional
};

struct DesignFacet {
    double index = 0;   ///< as it is given
    std::string label;  ///< written beside it; empty: none
    std::string facet;  ///< of the solid; empty: it bounds nothing, or repeats an earlier one
};

struct DesignTier {
    CutSetting setting;       ///< of all its facets, but for the index
    std::string instruction;  ///< such as "Meet 1-2-G1"; empty: none
    std::vector<DesignFacet> facets;
};

struct Design {
    double gear = 96;            ///< index teeth; negative counts the other way round
    bool gear_supposed = false;  ///< the file does not state it
    double gear_offset = 0;
    int symmetry = 1;
    bool mirror = false;
    std::optional<double> refractive_index;
    std::vector<std::string> headings, footnotes;
    std::vector<DesignTier> tiers;  ///< in the order of cutting
};

/// n = (sin a sin t, sin a cos t, +-cos a) with t = 2 pi (index - offset) / gear. Exact at whole
/// quarters, so that a girdle stands upright and a table lies flat.
Plane plane_of(const CutSetting& setting, const Design& design);

/// The inverse; the index lies in (0, |gear|].
CutSetting setting_of(const Plane& plane, const Design& design);

struct DesignPlace {
    int tier = -1, facet = -1;  ///< of the design; -1: it does not have the facet
};

/// Of each facet of the solid, by its name, in the solid's design.
std::vector<DesignPlace> places_of(const Solid& solid);

/// What a cutter calls the tiers: the one label of a tier; what its labels have in common where no
/// other tier has that too, else the first of them; P1, G1, C1, ... by side where it has none.
std::vector<std::string> tier_titles(const Design& design);

/// The design that a mesh shows: its tiers (tiers.h), pavilion before girdle before crown, the
/// steepest first; their symmetry; index settings on a wheel of 96 teeth. z is up.
Design drawn_design(const Solid& solid);

/// The solid's own, or else the drawn one.
Design cutting_design(const Solid& solid);

/// Facets of one tier that a file gives line by line, because each has its own angle (a fitted
/// stone), stand in one tier again: those of the same stem of a name (`C` of C1, `A` of A.1) that
/// the solid's drawing has as one tier. Their tier has their mean angle and distance.
void join_split_tiers(const Solid& solid, Design& design);

/// As lines of GemCad's .asc, that tell facets' names besides; and back. Throws InputError.
std::string design_text(const Design& design);
Design design_in(std::string_view text);

}  // namespace culet
