// Names that run round the other way than they are drawn.

#include <cmath>
#include <glm/geometric.hpp>

#include "fit/mesh/orientation.h"
#include "fit/mesh/repair.h"

namespace culet {

std::optional<Stone> mirrored_to_azimuths(const Stone& stone,
                                          const std::vector<Reading>& readings) {
    // Azimuths read less those drawn agree up to one turn, or their sums do: mean directions.
    const Vec3 up = [&] {
        const int f = stone.up_facet.empty() ? -1 : find_facet(stone.solid, stone.up_facet);
        return f < 0 ? glm::normalize(stone.up) : stone.solid.facets[f].plane.normal;
    }();
    const Vec3 side =
        glm::normalize(glm::cross(std::abs(up.x) < 0.8 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}, up));
    const Vec3 other = glm::cross(up, side);
    double ways[2][2] = {{0, 0}, {0, 0}};
    int count = 0;
    for (const Reading& r : readings) {
        // Outlines and photographs have shown which way round it is.
        if (r.told || r.photograph) return std::nullopt;
        if (r.kind != ReadingKind::azimuth || r.datum.kind == Datum::Kind::facet) continue;
        const Vec3& n = stone.solid.facets[r.facets[0]].plane.normal;
        const double drawn = std::atan2(glm::dot(n, other), glm::dot(n, side));
        for (int way = 0; way < 2; ++way) {
            const double angle = r.value + (way == 0 ? -drawn : drawn);
            ways[way][0] += std::cos(angle);
            ways[way][1] += std::sin(angle);
        }
        ++count;
    }
    const double straight = std::hypot(ways[0][0], ways[0][1]),
                 turned = std::hypot(ways[1][0], ways[1][1]);
    if (count < 3 || turned < 0.5 * count || straight > 0.7 * turned) return std::nullopt;
    Stone result = stone;
    for (Vec3& v : result.solid.vertices) v -= 2 * glm::dot(v, side) * side;
    turn_round(result.solid);
    return result;
}

}  // namespace culet
