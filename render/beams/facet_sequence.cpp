#include "render/beams/facet_sequence.h"

#include <glm/geometric.hpp>

#include "render/optics/fresnel.h"

namespace culet {

void find_facets(const ConvexBody& body, const ScreenView& view, const ScreenPoint& at, double n,
                 int depth, double cut_weight, std::vector<std::uint16_t>& facets) {
    facets.clear();
    const Vec3 origin = view.origin(at);
    Vec3 d = glm::normalize(view.towards(at));
    const auto entry = body.entry(origin, d);
    if (!entry) return;
    facets.push_back(static_cast<std::uint16_t>(entry->facet));
    Vec3 point = body.on_facet(entry->facet, origin + entry->distance * d);
    const Vec3& normal = body.normal(entry->facet);
    const double q1 = -glm::dot(d, normal);
    const FaceAmplitudes face = fresnel(1.0, n, q1);
    double weight = 0.5 * (face.t_s * face.t_s + face.t_p * face.t_p);
    d = glm::normalize(d + (q1 - face.q2) * normal);
    while (static_cast<int>(facets.size()) < depth && !(weight < cut_weight)) {
        const BodyHit hit = body.exit(point, d);
        facets.push_back(static_cast<std::uint16_t>(hit.facet));
        point = body.on_facet(hit.facet, point + hit.distance * d);
        const Vec3& m = body.normal(hit.facet);
        const double cosine = glm::dot(d, m);
        const FaceAmplitudes out = fresnel(n, 1.0, n * cosine);
        if (!out.total) weight *= 0.5 * (std::norm(out.r_s) + std::norm(out.r_p));
        d = glm::normalize(d - 2 * cosine * m);
    }
}

}  // namespace culet
