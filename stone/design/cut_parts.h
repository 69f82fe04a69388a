#pragma once
// Where the parts of a cut meet: rims, tips of stars and halves, and the girdle's thickness.
// Private to this folder.

#include <array>
#include <optional>
#include <set>
#include <vector>

#include "stone/design/cut_measures.h"

namespace culet {

/// Corners at which the girdle (or, without one, the other side) meets this side.
std::set<int> rim_of(const Solid& solid, const CutRoles& roles, bool crown);

/// A star: its table edge, its tip, and the girdle's corner below.
struct StarTip {
    std::array<int, 2> edge{};
    int tip = -1, girdle = -1;
};
std::vector<StarTip> star_tips(const Solid& solid, const CutRoles& roles, const std::set<int>& rim);

/// A pair of lower halves: the girdle's corner between them, and their common tip.
struct HalfTip {
    int girdle = -1, tip = -1;
};
std::vector<HalfTip> half_tips(const Solid& solid, const CutRoles& roles, const std::set<int>& rim);

/// The girdle's thickness at a corner: up or down to the edge (or corner, if both are one) across.
struct Chord {
    int facet = -1, corner = -1;
    std::array<int, 2> across{};
    double sign = 1;

    double length(const std::vector<Vec3>& at) const;
};
std::vector<Chord> girdle_chords(const Solid& solid, const CutRoles& roles);

/// A girdle facet's corners, counter-clockwise from outside, and the two at its ends.
struct GirdleFlat {
    std::vector<int> corners;
    std::array<int, 2> ends{};
};
std::vector<GirdleFlat> girdle_flats(const Solid& solid, const CutRoles& roles);
/// Their area over their extent in plan.
double mean_thickness(const std::vector<GirdleFlat>& flats, const std::vector<Vec3>& at);

}  // namespace culet
