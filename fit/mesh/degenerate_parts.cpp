#include "fit/mesh/degenerate_parts.h"

#include "stone/numbers/units.h"
#include "stone/solid/half_edges.h"

namespace culet {

namespace {

// Parts of the diameter, and degrees: below what calipers and goniometers resolve.
constexpr double k_no_width = 1e-5, k_one_plane_deg = 1e-3;

}  // namespace

DegenerateParts degenerate_parts(const Solid& solid) {
    DegenerateParts result;
    const double least = k_no_width * diameter(solid);
    for (const Facet& facet : solid.facets) {
        if (narrow_width(solid, facet) < least) result.facets.push_back(facet.name);
    }
    for (const Edge& edge : half_edges(solid).edges) {
        const Facet &left = solid.facets[std::size_t(edge.left)],
                    &right = solid.facets[std::size_t(edge.right)];
        if (angle_between(left.plane.normal, right.plane.normal) < radians(k_one_plane_deg)) {
            result.edges.push_back(left.name + "|" + right.name);
        }
    }
    return result;
}

}  // namespace culet
