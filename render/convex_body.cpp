#include "render/convex_body.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>

#include "stone/errors.h"

namespace culet {

ConvexBody::ConvexBody(const Solid& solid) {
    for (const Facet& facet : solid.facets) {
        normals_.push_back(facet.plane.normal);
        nx_.push_back(facet.plane.normal.x);
        ny_.push_back(facet.plane.normal.y);
        nz_.push_back(facet.plane.normal.z);
        offset_.push_back(facet.plane.offset);
    }
}

std::optional<BodyHit> ConvexBody::entry(const Vec3& origin, const Vec3& direction) const {
    BodyHit hit;
    double enter = -std::numeric_limits<double>::infinity(), leave = -enter;
    for (std::size_t f = 0; f < offset_.size(); ++f) {
        const double towards = glm::dot(normals_[f], direction);
        const double below = offset_[f] - glm::dot(normals_[f], origin);
        if (towards < 0) {
            const double distance = below / towards;
            if (distance > enter) {
                enter = distance;
                hit.facet = static_cast<int>(f);
            }
        } else if (towards > 0) {
            leave = std::min(leave, below / towards);
        } else if (below < 0) {
            return std::nullopt;
        }
    }
    if (hit.facet < 0 || enter < 0 || !(enter < leave)) return std::nullopt;
    hit.distance = enter;
    return hit;
}

BodyHit ConvexBody::exit(const Vec3& origin, const Vec3& direction) const {
    // The largest of towards/below is the nearest plane; both are positive for the planes that
    // count.
    BodyHit hit;
    double best = std::numeric_limits<double>::infinity();
    const std::size_t count = offset_.size();
    const double *nx = nx_.data(), *ny = ny_.data(), *nz = nz_.data(), *offset = offset_.data();
    constexpr std::size_t k_block = 8;
    for (std::size_t start = 0; start < count; start += k_block) {
        double towards[k_block], below[k_block];
        const std::size_t size = std::min(k_block, count - start);
        for (std::size_t i = 0; i < size; ++i) {
            const std::size_t f = start + i;
            towards[i] = nx[f] * direction.x + ny[f] * direction.y + nz[f] * direction.z;
            below[i] = offset[f] - (nx[f] * origin.x + ny[f] * origin.y + nz[f] * origin.z);
        }
        for (std::size_t i = 0; i < size; ++i) {
            if (towards[i] > 0 && below[i] < best * towards[i]) {
                best = std::max(below[i], 0.0) / towards[i];
                hit.facet = static_cast<int>(start + i);
            }
        }
    }
    check(hit.facet >= 0, "a ray inside the stone met no facet");
    hit.distance = best;
    return hit;
}

bool ConvexBody::contains(const Vec3& point) const {
    for (std::size_t f = 0; f < offset_.size(); ++f) {
        if (glm::dot(normals_[f], point) >= offset_[f]) return false;
    }
    return true;
}

Vec3 ConvexBody::on_facet(int facet, const Vec3& point) const {
    const std::size_t f = static_cast<std::size_t>(facet);
    return point - (glm::dot(normals_[f], point) - offset_[f]) * normals_[f];
}

}  // namespace culet
