#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "fit/model/canonical.h"

namespace culet {

bool lies_mirrored(const Solid& solid, const HalfEdges& edges) {
    const std::optional<Shape> canonical = canonical_polyhedron(solid, edges);
    if (!canonical) return volume(solid) < 0;
    Vec3 from(0), to(0);
    const double share = 1 / static_cast<double>(solid.vertices.size());
    for (std::size_t v = 0; v < solid.vertices.size(); ++v) {
        from += share * canonical->points[v];
        to += share * solid.vertices[v];
    }
    // Sign of the determinant of the cross moments (Kabsch 1976).
    glm::dmat3 cross(0.0);
    for (std::size_t v = 0; v < solid.vertices.size(); ++v) {
        cross += glm::outerProduct(solid.vertices[v] - to, canonical->points[v] - from);
    }
    return glm::determinant(cross) < 0;
}

}  // namespace culet
