#include <glm/geometric.hpp>

#include "render/beams/beam_shading.h"

namespace culet {

ShadedStone::ShadedStone(const FacetNet& net) : size(static_cast<float>(net.size())) {
    Vec3 low(1e300), high(-1e300);
    for (const Vec3& corner : net.corners()) {
        low = glm::min(low, corner);
        high = glm::max(high, corner);
    }
    middle = 0.5 * (low + high);
    const auto number_of = [](double v) { return static_cast<float>(v); };
    for (int f = 0; f < net.facets(); ++f) {
        const Plane& plane = net.plane(f);
        const Vec3& n = plane.normal;
        const auto& edges = net.edges(f);
        faces.push_back({number_of(n.x), number_of(n.y), number_of(n.z),
                         number_of(plane.offset - glm::dot(n, middle)),
                         static_cast<std::uint32_t>(sides.size()),
                         static_cast<std::uint32_t>(edges.size())});
        for (const NetEdge& edge : edges) {
            const Vec3 from = net.corners()[static_cast<std::size_t>(edge.from)] - middle,
                       to = net.corners()[static_cast<std::size_t>(edge.to)] - middle;
            const Vec3 across = glm::normalize(glm::cross(to - from, n));
            sides.push_back({number_of(across.x), number_of(across.y), number_of(across.z),
                             number_of(0.5 * glm::dot(across, from + to))});
        }
    }
}

ShadedEye shaded_eye(const ScreenView& view, const ScreenPoint& at, const Plane& front,
                     const Vec3& middle) {
    const Vec3 origin = view.origin(at), v = view.towards(at);
    const double length = glm::length(v);
    const Vec3 direction = v / length;
    const double distance = -height_above(front, origin) / glm::dot(front.normal, direction);
    ShadedEye eye;
    const auto store = [](const Vec3& from, float* to) {
        for (int i = 0; i < 3; ++i) to[i] = static_cast<float>(from[i]);
    };
    store(origin + distance * direction - middle, eye.point);
    store(direction, eye.direction);
    store(view.vx / length, eye.direction_x);
    store(view.vy / length, eye.direction_y);
    store(view.forward, eye.forward);
    store(view.right, eye.right);
    store(view.ox, eye.origin_x);
    store(view.oy, eye.origin_y);
    store(view.ox + distance / length * view.vx, eye.point_x);
    store(view.oy + distance / length * view.vy, eye.point_y);
    eye.distance = static_cast<float>(distance);
    return eye;
}

ShadedEye shaded_eye(const ScreenView& view, const ScreenPoint& at, const Vec3& middle) {
    const Vec3 origin = view.origin(at), v = view.towards(at);
    return shaded_eye(view, at, Plane{-glm::normalize(v), -glm::dot(glm::normalize(v), origin)},
                      middle);
}

}  // namespace culet
