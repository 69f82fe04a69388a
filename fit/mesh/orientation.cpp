#include "fit/mesh/orientation.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "stone/mesh/face_orientation.h"

namespace culet {

void renew_plane(Solid& solid, Facet& facet) {
    std::vector<Vec3> loop;
    for (int corner : facet.corners) loop.push_back(solid.vertices[corner]);
    facet.plane = plane_through(loop);
}

void turn_round(Solid& solid) {
    for (Facet& facet : solid.facets) {
        std::reverse(facet.corners.begin(), facet.corners.end());
        renew_plane(solid, facet);
    }
}

std::optional<int> orient(Solid& solid) {
    std::vector<FaceSide> sides;
    for (std::size_t f = 0; f < solid.facets.size(); ++f)
        add_sides(solid.facets[f].corners, static_cast<int>(f), sides);
    const auto found = faces_to_turn(solid.facets.size(), std::move(sides));
    if (!found || found->parts != 1) return std::nullopt;
    const int turned = static_cast<int>(std::count(found->turn.begin(), found->turn.end(), true));
    if (turned == 0) return 0;
    for (std::size_t f = 0; f < solid.facets.size(); ++f) {
        if (!found->turn[f]) continue;
        std::reverse(solid.facets[f].corners.begin(), solid.facets[f].corners.end());
        renew_plane(solid, solid.facets[f]);
    }
    if (volume(solid) > 0) return turned;
    turn_round(solid);
    return static_cast<int>(solid.facets.size()) - turned;
}

}  // namespace culet
