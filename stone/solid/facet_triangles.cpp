#include "stone/solid/facet_triangles.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace culet {

std::vector<std::array<int, 3>> facet_triangles(const Solid& solid, const Facet& facet) {
    std::vector<int> left = facet.corners;
    std::vector<std::array<int, 3>> triangles;
    const auto turn = [&](int a, int b, int c) {
        const Vec3 &A = solid.vertices[a], &B = solid.vertices[b], &C = solid.vertices[c];
        return glm::dot(facet.plane.normal, glm::cross(B - A, C - B));
    };
    const auto is_ear = [&](std::size_t i) {
        const int a = left[(i + left.size() - 1) % left.size()], b = left[i],
                  c = left[(i + 1) % left.size()];
        if (!(turn(a, b, c) > 0)) return false;
        return std::none_of(left.begin(), left.end(), [&](int p) {
            return p != a && p != b && p != c && turn(a, b, p) >= 0 && turn(b, c, p) >= 0 &&
                   turn(c, a, p) >= 0;
        });
    };
    while (left.size() > 3) {
        // Starts at the second corner, so that a convex facet becomes a fan about its first. If
        // rounding leaves no ear, the rest has no width and any corner will do.
        std::size_t ear = 1;
        for (std::size_t i = 0; i < left.size(); ++i) {
            if (is_ear((1 + i) % left.size())) {
                ear = (1 + i) % left.size();
                break;
            }
        }
        triangles.push_back({left[(ear + left.size() - 1) % left.size()], left[ear],
                             left[(ear + 1) % left.size()]});
        left.erase(left.begin() + static_cast<std::ptrdiff_t>(ear));
    }
    if (left.size() == 3) triangles.push_back({left[0], left[1], left[2]});
    return triangles;
}

}  // namespace culet
