// Detects names that run round the other way than drawn, and mirrors the mesh.

#include <cmath>
#include <glm/geometric.hpp>

#include "fit/mesh/orientation.h"
#include "fit/mesh/repair.h"
#include "stone/solid/caliper.h"
#include "stone/upright.h"

namespace culet {

namespace {

// Azimuths read: fewer tell too little. Not tuned.
constexpr int k_least_azimuths = 3;
// Mean resultant lengths (1: all agree on one turn): the mirrored mesh's is at least this, and the
// drawn one's at most this part of it. Not tuned.
constexpr double k_agree = 0.5, k_disagree = 0.7;

}  // namespace

std::optional<Stone> mirrored_to_azimuths(const Stone& stone,
                                          const std::vector<Reading>& readings) {
    // The azimuths read minus (or, if mirrored, plus) those drawn share one turn: compare the mean
    // resultant lengths.
    const PlanFrame frame = plan_frame(up_of(stone));
    double ways[2][2] = {{0, 0}, {0, 0}};
    int count = 0;
    for (const Reading& r : readings) {
        // Outlines, lines and photographs have already shown the handedness.
        if (r.outline_observations || r.seen_line || r.photograph) return std::nullopt;
        if (r.kind != ReadingKind::azimuth || r.datum.kind == Datum::Kind::facet) continue;
        const Vec3& n = stone.solid.facets[r.facets[0]].plane.normal;
        const double drawn = std::atan2(glm::dot(n, frame.y), glm::dot(n, frame.x));
        for (int way = 0; way < 2; ++way) {
            const double angle = r.value + (way == 0 ? -drawn : drawn);
            ways[way][0] += std::cos(angle);
            ways[way][1] += std::sin(angle);
        }
        ++count;
    }
    const double straight = std::hypot(ways[0][0], ways[0][1]),
                 turned = std::hypot(ways[1][0], ways[1][1]);
    if (count < k_least_azimuths || turned < k_agree * count || straight > k_disagree * turned)
        return std::nullopt;
    Stone result = stone;
    for (Vec3& v : result.solid.vertices) v -= 2 * glm::dot(v, frame.y) * frame.y;
    turn_round(result.solid);
    return result;
}

}  // namespace culet
