#include "fit/silhouettes/silhouette_start.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "stone/numbers/units.h"
#include "stone/upright.h"

namespace culet {

namespace {

// Sigma of a facet's tilt: facets of catalogue cuts are off by at most a few times this.
const double k_start_tilt = radians(2.0);
// Sigma of the up facet's tilt. If hidden, the stone stands on it, perpendicular to the turntable's
// axis, which the registration finds as well.
const double k_up_tilt = radians(0.3);

Plane placed_plane(const Plane& plane, const Similarity& at) {
    const Vec3 normal = glm::normalize(at.motion.turned(plane.normal));
    return {normal, at.scale * plane.offset + glm::dot(normal, at.motion.shift)};
}

}  // namespace

std::vector<FlatContour> flattened(const std::vector<Contour>& contours, int set) {
    std::vector<FlatContour> all;
    for (const Contour& c : contours) all.push_back(flattened(c, set));
    return all;
}

SilhouetteStart silhouette_start(const Stone& mesh,
                                 const std::vector<std::shared_ptr<const SilhouetteSet>>& sets) {
    SilhouetteStart start;
    start.in_mesh_frame =
        std::any_of(sets.begin(), sets.end(), [](const auto& s) { return !s->is_free; });
    const std::vector<Vec3>& corners = mesh.solid.vertices;
    if (start.in_mesh_frame) {
        std::vector<FlatContour> fixed;
        for (const auto& set : sets) {
            if (set->is_free) continue;
            for (const Contour& c : set->contours) fixed.push_back(flattened(c, 0));
        }
        start.from_mesh =
            registered(corners, fixed, {}, {.turns = false, .shifts = true, .scales = true});
    } else {
        start.from_mesh = found_registration(corners, up_of(mesh), flattened(sets[0]->contours, 0));
    }
    const std::vector<Vec3> placed = placed_corners(corners, start.from_mesh);
    PlaneFitProblem& problem = start.problem;
    for (const Facet& facet : mesh.solid.facets) {
        std::vector<Vec3> loop;
        for (const int c : facet.corners) loop.push_back(mesh.solid.vertices[std::size_t(c)]);
        problem.start.push_back(placed_plane(plane_through(loop), start.from_mesh));
        problem.start_tilts.push_back(facet.name == mesh.up_facet ? k_up_tilt : k_start_tilt);
    }
    Vec3 least(1e300), most(-1e300);
    for (const Vec3& c : placed) {
        least = glm::min(least, c);
        most = glm::max(most, c);
    }
    problem.width = glm::length(most - least);
    const Vec3 up = start.from_mesh.motion.turned(up_of(mesh));
    for (std::size_t s = 0; s < sets.size(); ++s) {
        std::vector<FlatContour> flat = flattened(sets[s]->contours, int(s));
        const bool is_own = sets[s]->is_free && (start.in_mesh_frame || s > 0);
        FrameMotion motion;
        if (is_own) {
            std::vector<FlatContour> alone = flattened(sets[s]->contours, 0);
            motion = inverse(found_registration(placed, up, alone).motion);
        }
        problem.from.motions.push_back(motion);
        problem.is_free.push_back(is_own);
        problem.stated_sigmas.push_back(0);
        if (sets[s]->has_sigma() && !sets[s]->contours.empty()) {
            // Contours with another sigma get another weight.
            const double sigma = sets[s]->contours[0].sigma;
            problem.stated_sigmas.back() = sigma;
            for (FlatContour& c : flat) {
                for (double& w : c.weights) w *= std::pow(sigma / c.sigma, 2);
            }
        }
        for (FlatContour& c : flat) problem.contours.push_back(std::move(c));
    }
    return start;
}

}  // namespace culet
