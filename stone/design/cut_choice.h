#pragma once
// The corners and facets that count for a cut's proportions. Private to this folder.

#include <array>
#include <glm/geometric.hpp>
#include <vector>

#include "stone/design/cut_measures.h"
#include "stone/design/cut_parts.h"

namespace culet {

using CutCorners = std::vector<int>;
using CutPlaces = std::vector<Vec3>;
using CutPair = std::array<int, 2>;

inline Vec3 in_plan(const Vec3& v) {
    return {v.x, v.y, 0};
}
inline Vec3 between(const CutPlaces& at, const CutPair& ends) {
    return at[std::size_t(ends[1])] - at[std::size_t(ends[0])];
}
/// Of a loop's area in plan; of a single corner, itself.
Vec3 middle_of(const CutCorners& loop, const CutPlaces& at);

struct CutMeasures::Cut {
    CutCorners hull;                       // in plan, counter-clockwise
    CutPair jaw{};                         // ends of the hull's edge at one jaw of the least width
    int opposite = -1;                     // the corner at the other jaw
    CutPair ends{}, widest{};              // of the length; of the largest width
    CutCorners table, culet;               // loops
    CutPair table_ends{}, culet_ends{};    // along the least width
    std::vector<CutPair> table_extremes;   // corner to corner: the largest, the least
    CutCorners top, bottom, upper, lower;  // the girdle's upper and lower edge
    CutCorners crown_at_mains, pavilion_at_mains;  // corners of these edges
    std::vector<Chord> girdle_at_mains;
    CutCorners crown_extremes, pavilion_extremes;          // where mains meet these edges
    std::vector<Chord> girdle_extremes, girdle_variation;  // of all; of those at mains
    std::vector<GirdleFlat> flats;
    std::vector<StarTip> stars;
    std::vector<HalfTip> halves;
    // Directions in plan in which middles are apart.
    Vec3 table_off{1, 0, 0}, culet_off{1, 0, 0}, table_to_culet{1, 0, 0};
    bool is_round = false;

    CutCorners decisive;
    std::vector<Angle> angles;

    struct Along {
        Vec3 edge, across;  // in plan; `across` points inwards
    };
    Along along(const CutPlaces& at) const {
        const Vec3 edge = glm::normalize(in_plan(between(at, jaw)));
        return {edge, {-edge.y, edge.x, 0}};
    }
    const CutCorners& low() const { return culet.empty() ? bottom : culet; }

    void find_outline(const Solid& solid);
    void find_ends(const Solid& solid, const CutRoles& roles);
    void find_girdle(const Solid& solid, const CutRoles& roles);
    void find_offsets(const CutPlaces& at);
    void find_decisive();
    void find_angles(const Solid& solid, const CutRoles& roles);
};

}  // namespace culet
