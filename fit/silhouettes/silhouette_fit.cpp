#include "fit/silhouettes/silhouette_fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <set>

#include "fit/silhouettes/find_planes.h"
#include "fit/silhouettes/outline_rows.h"
#include "fit/silhouettes/plane_fit.h"
#include "fit/silhouettes/registration.h"
#include "fit/silhouettes/silhouette_start.h"
#include "stone/text/errors.h"
#include "stone/upright.h"

namespace culet {

namespace {

using Sets = std::vector<std::shared_ptr<const SilhouetteSet>>;

std::string name_of_added(const Vec3& normal, const Solid& mesh, const std::vector<Vec3>& normals,
                          std::set<std::string>& taken) {
    std::size_t nearest = 0;
    for (std::size_t f = 1; f < normals.size(); ++f) {
        if (glm::dot(normal, normals[f]) > glm::dot(normal, normals[nearest])) nearest = f;
    }
    for (int k = 1;; ++k) {
        std::string name = fmt::format("{}.{}", mesh.facets[nearest].name, k);
        if (taken.insert(name).second) return name;
    }
}

// The rigid motion from the fit back to the mesh's place and up direction.
FrameMotion to_mesh_frame(const Stone& mesh, const SilhouetteStart& start,
                          const FoundPlanes& found) {
    if (start.in_mesh_frame) return {};
    FrameMotion back = inverse(start.from_mesh.motion);
    Vec3 middle(0), mine(0);
    for (const Vec3& v : mesh.solid.vertices) middle += v / double(mesh.solid.vertices.size());
    const int up = mesh.up_facet.empty() ? -1 : find_facet(mesh.solid, mesh.up_facet);
    for (std::size_t p = 0; p < found.fit.planes.size(); ++p) {
        if (up < 0 || found.mesh_facet[p] != up) continue;
        // The smallest turn that restores the up facet's normal.
        const Vec3 from = back.turned(found.fit.planes[p].normal), to = up_of(mesh);
        const Vec3 axis = glm::cross(from, to);
        const double cosine = glm::dot(from, to);
        if (!(glm::length(axis) > 0) || cosine < 0) continue;
        const auto turned = [&](const Vec3& v) {
            return cosine * v + glm::cross(axis, v) + glm::dot(axis, v) / (1 + cosine) * axis;
        };
        back.x = turned(back.x);
        back.y = turned(back.y);
        back.z = turned(back.z);
    }
    for (const Vec3& v : found.fit.body.corners) {
        mine += back.turned(v) / double(found.fit.body.corners.size());
    }
    back.shift = middle - mine;
    return back;
}

FrameMotion product(const FrameMotion& a, const FrameMotion& b) {
    FrameMotion both;
    both.x = a.turned(b.x);
    both.y = a.turned(b.y);
    both.z = a.turned(b.z);
    both.shift = a.moved(b.shift);
    return both;
}

// The stone in the mesh's place, with named facets.
Stone named_stone(const Stone& mesh, const FoundPlanes& found, const FrameMotion& back) {
    std::set<std::string> taken;
    std::vector<Vec3> normals;
    for (const Facet& f : mesh.solid.facets) {
        taken.insert(f.name);
        normals.push_back(f.plane.normal);
    }
    std::vector<NamedPlane> planes;
    for (std::size_t p = 0; p < found.fit.planes.size(); ++p) {
        const Vec3 normal = glm::normalize(back.turned(found.fit.planes[p].normal));
        const double offset = found.fit.planes[p].offset + glm::dot(normal, back.shift);
        const int facet = found.mesh_facet[p];
        planes.push_back({facet >= 0 ? mesh.solid.facets[std::size_t(facet)].name
                                     : name_of_added(normal, mesh.solid, normals, taken),
                          {normal, offset}});
    }
    Stone stone = mesh;
    stone.solid = intersect_half_spaces(planes).solid;
    stone.facets_are_whole = true;
    if (!mesh.up_facet.empty() && find_facet(stone.solid, mesh.up_facet) < 0) {
        throw InputError(
            fmt::format("the outlines leave no room for the facet '{}' that `up` of [stone] names: "
                        "start from a cut more like the stone, or give `up` as a vector",
                        mesh.up_facet));
    }
    if (stone.solid.facets.size() != planes.size()) {
        throw InputError(
            "which facets the outlines show depends on rounding: no stone with these facets has "
            "them");
    }
    if (!stone.up_facet.empty()) stone.up = up_of(stone);
    return stone;
}

std::string list_of(const std::vector<std::string>& names) {
    constexpr std::size_t k_most = 12;
    std::string text;
    for (std::size_t i = 0; i < names.size() && i < k_most; ++i) {
        text += (i == 0 ? "" : ", ") + names[i];
    }
    if (names.size() > k_most) text += fmt::format(" and {} more", names.size() - k_most);
    return text;
}

// Notes on mesh facets without room, on facets that the outlines hardly see, and on added ones.
std::vector<std::string> notes_of(const Stone& mesh, const FoundPlanes& found, const Solid& solid,
                                  std::vector<int> unseen) {
    std::vector<std::string> notes, names;
    for (const int f : found.lost) names.push_back(mesh.solid.facets[std::size_t(f)].name);
    if (!names.empty()) {
        notes.push_back("the outlines leave no room for the mesh's facets " + list_of(names) +
                        ": they are left out");
    }
    names.clear();
    // The largest first.
    std::stable_sort(unseen.begin(), unseen.end(), [&](int a, int b) {
        return area(solid, solid.facets[std::size_t(a)]) >
               area(solid, solid.facets[std::size_t(b)]);
    });
    for (const int p : unseen) names.push_back(solid.facets[std::size_t(p)].name);
    if (!names.empty()) {
        notes.push_back("the outlines hardly tell how these facets lie: " + list_of(names));
    }
    const std::size_t added = solid.facets.size() - mesh_planes(found);
    if (added > 0) {
        notes.push_back(
            fmt::format("the outlines show {} facet{} more than the mesh has, most of them where "
                        "it has few for "
                        "a round girdle: named after the nearest facet",
                        added, added == 1 ? "" : "s"));
    }
    return notes;
}

}  // namespace

SilhouetteFit fit_silhouettes(const Stone& mesh, const Sets& sets) {
    if (!mesh.convex) {
        throw InputError(
            "outlines show a convex stone only: take `convex = false` or the "
            "[[silhouette]] tables out of the stone file");
    }
    SilhouetteStart start = silhouette_start(mesh, sets);
    const FoundPlanes found = find_planes(mesh, start.problem);
    SilhouetteFit result;
    const FrameMotion back = to_mesh_frame(mesh, start, found);
    result.stone = named_stone(mesh, found, back);

    FrameHolds holds;
    holds.up = up_of(result.stone);
    holds.tilts = start.in_mesh_frame && mesh.up_facet.empty();
    holds.turn = start.in_mesh_frame && mesh.azimuth_from_mesh;
    const PlaneInformation information = plane_information(start.problem, found.fit);
    OutlineRows rows = outline_rows(found.fit.planes, information.matrix, start.problem.start_tilts,
                                    start.problem.width, back, holds);
    auto observations = std::make_shared<OutlineObservations>();
    for (const Facet& facet : result.stone.solid.facets)
        observations->planes.push_back(facet.plane);
    observations->rows = std::move(rows.rows);
    observations->chi2 = information.chi2;
    observations->dof = information.chi2_dof;
    for (std::size_t s = 0; s < sets.size(); ++s) {
        observations->motions.push_back(product(back, found.fit.from.motions[s]));
        observations->sigmas.push_back(information.sigmas[s]);
        observations->estimated.push_back(!(start.problem.stated_sigmas[s] > 0));
    }
    result.observations = std::move(observations);
    result.notes = notes_of(mesh, found, result.stone.solid, rows.unseen);
    return result;
}

SilhouetteMisfit silhouette_misfit(const Solid& solid, const std::vector<Contour>& fitted,
                                   const std::vector<Contour>& contours,
                                   const FrameMotion& motion) {
    const Similarity start{inverse(motion), 1};
    const Similarity at = registered(solid.vertices, flattened(fitted, 0), start, {});
    const std::vector<Vec3> corners = placed_corners(solid.vertices, at);
    const std::vector<FlatContour> flat = flattened(contours, 0);
    return misfit_of(outline_distances(corners, flat, {std::vector<FrameMotion>(1), {}}), flat, 0);
}

}  // namespace culet
