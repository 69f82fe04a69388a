#include "viewer/engine/view_questions.h"

#include "render/beams/screen_view.h"
#include "render/geometry/stone_body.h"
#include "render/reference/probe.h"

namespace culet {

int facet_at(const Stone& stone, const Camera& camera, double x, double y) {
    const EyeRay ray = EyeRays(camera).through(x, y);
    const auto hit = StoneBody(stone.solid, stone.convex).entry(ray.origin, ray.direction);
    return hit ? hit->facet : -1;
}

std::vector<PickedFacet> seen_facets(const Stone& stone, const Camera& camera) {
    Camera pinhole = camera;
    pinhole.aperture_radius = 0;
    const ScreenView view = screen_view(pinhole);
    std::vector<PickedFacet> seen;
    for (std::size_t f = 0; f < stone.solid.facets.size(); ++f) {
        const Facet& facet = stone.solid.facets[f];
        if (!view.sees(facet.plane)) continue;
        PickedFacet one{static_cast<int>(f), {}};
        for (const int corner : facet.corners) {
            const ScreenImage image =
                view.of_point(stone.solid.vertices[static_cast<std::size_t>(corner)]);
            if (!(image.z > 0)) break;  // behind the eye
            one.points.push_back({image.x / image.z, image.y / image.z});
        }
        if (one.points.size() == facet.corners.size()) seen.push_back(std::move(one));
    }
    return seen;
}

std::string paths_at(const Scene& scene, double x, double y) {
    return probe_json(probe(scene, EyeRays(scene.camera).through(x, y)));
}

}  // namespace culet
