#include "fit/model/outline_corners.h"

#include <glm/geometric.hpp>

namespace culet {

std::vector<Corner> corners_of(const Outline& outline, int facet) {
    std::vector<Corner> corners;
    for (int c : outline.loops[facet]) corners.push_back(outline.corners[c]);
    return corners;
}

std::vector<Corner> shared_edge(const Outline& outline, int a, int b) {
    const std::vector<int>&loop = outline.loops[a], &other = outline.loops[b];
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const int from = loop[i], to = loop[(i + 1) % loop.size()];
        for (std::size_t k = 0; k < other.size(); ++k) {
            if (other[k] == to && other[(k + 1) % other.size()] == from) {
                return {outline.corners[from], outline.corners[to]};
            }
        }
    }
    return {};
}

Corner farthest(const Shape& shape, const std::vector<Corner>& corners, const Vec3& direction) {
    Corner best = corners.front();
    double most = -1e300;
    for (const Corner& c : corners) {
        const double along = glm::dot(direction, place_of(shape, c));
        if (along > most) {
            most = along;
            best = c;
        }
    }
    return best;
}

}  // namespace culet
