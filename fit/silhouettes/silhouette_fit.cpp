#include "fit/silhouettes/silhouette_fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <set>

#include "fit/silhouettes/missing_facets.h"
#include "fit/silhouettes/outline_knowledge.h"
#include "fit/silhouettes/plane_fit.h"
#include "fit/silhouettes/registration.h"
#include "fit/silhouettes/silhouette_start.h"
#include "stone/errors.h"
#include "stone/units.h"

namespace culet {

namespace {

// On the way points count that lie no farther off than this part of the width.
constexpr double k_reach = 0.01;
constexpr int k_first_steps = 40, k_round_steps = 8, k_last_steps = 30, k_rounds = 8;
// A stone has no more facets; the fit's equations are dense in them.
constexpr std::size_t k_most_planes = 400;
// A facet that outlines added and that is narrower than so many of its offset's sigmas is none.
constexpr double k_narrow = 4;
const double k_alike = radians(6.0);

using Sets = std::vector<std::shared_ptr<const SilhouetteSet>>;

// Planes that have no facet, or that outlines added and that are too narrow to be one.
std::vector<bool> kept_planes(const PlaneFit& fit, std::size_t of_mesh, bool at_the_end) {
    double scale = 0;
    for (const double s : fit.scales) scale = std::max(scale, s);
    std::vector<bool> kept = fit.body.present;
    for (const Facet& facet : fit.body.solid.facets) {
        const auto plane = std::size_t(std::stoi(facet.name));
        if (plane < of_mesh) continue;
        kept[plane] = narrow_width(fit.body.solid, facet) > k_narrow * scale;
    }
    // On the way a facet of the mesh may come back.
    for (std::size_t p = 0; p < of_mesh && !at_the_end; ++p) kept[p] = true;
    return kept;
}

// A cut that looks much as a facet of the mesh does for which there was no room is that facet.
bool is_lost_facet(const Plane& cut, PlaneFitProblem& problem, PlaneFit& fit, std::size_t of_mesh) {
    for (std::size_t p = 0; p < of_mesh; ++p) {
        if (fit.body.present[p] || angle_between(problem.start[p].normal, cut.normal) > k_alike) {
            continue;
        }
        problem.start[p] = fit.planes[p] = cut;
        fit.body.present[p] = true;
        return true;
    }
    return false;
}

// Planes of the mesh stay where they come first, in its order.
struct Found {
    PlaneFit fit;
    std::vector<int> mesh_facet;  ///< of each plane; -1: the outlines added it
    std::vector<int> lost;        ///< facets of the mesh
};

// Only these planes go on.
void keep(const std::vector<bool>& kept, PlaneFitProblem& problem, Found& found) {
    std::vector<Plane> start, planes;
    std::vector<int> facets;
    for (std::size_t p = 0; p < kept.size(); ++p) {
        if (!kept[p]) {
            if (found.mesh_facet[p] >= 0) found.lost.push_back(found.mesh_facet[p]);
            continue;
        }
        start.push_back(problem.start[p]);
        planes.push_back(found.fit.planes[p]);
        facets.push_back(found.mesh_facet[p]);
    }
    problem.start = std::move(start);
    found.fit.planes = std::move(planes);
    found.mesh_facet = std::move(facets);
}

// From where an earlier round ended; the start's pull stays where the start was.
void run_on(const PlaneFitProblem& problem, int steps, const std::function<void()>& goes_on,
            Found& found) {
    const int before = found.fit.steps;
    PlaneFitProblem from_here = problem;
    from_here.motions = found.fit.motions;
    found.fit = fit_planes(from_here, found.fit.planes, steps, goes_on);
    found.fit.steps += before;
    if (!found.fit.body.closed) {
        throw InputError(
            "the planes of the outlines enclose no stone: are they of this stone, and "
            "their directions along the line of sight?");
    }
}

std::size_t mesh_planes(const Found& found) {
    return std::size_t(std::count_if(found.mesh_facet.begin(), found.mesh_facet.end(),
                                     [](int f) { return f >= 0; }));
}

Found find_planes(PlaneFitProblem& problem, const std::function<void()>& goes_on) {
    Found found;
    for (std::size_t f = 0; f < problem.start.size(); ++f) found.mesh_facet.push_back(int(f));
    found.fit.planes = problem.start;
    found.fit.motions = problem.motions;
    problem.reach = k_reach * problem.width;
    run_on(problem, k_first_steps, goes_on, found);
    for (int round = 0; round < k_rounds; ++round) {
        const std::size_t room = k_most_planes - std::min(k_most_planes, problem.start.size());
        const std::vector<Plane> more = missing_planes(problem, found.fit, room);
        if (more.empty()) break;
        for (const Plane& plane : more) {
            if (is_lost_facet(plane, problem, found.fit, mesh_planes(found))) continue;
            problem.start.push_back(plane);
            found.fit.planes.push_back(plane);
            found.mesh_facet.push_back(-1);
        }
        run_on(problem, k_round_steps, goes_on, found);
        keep(kept_planes(found.fit, mesh_planes(found), false), problem, found);
        run_on(problem, 0, goes_on, found);
    }
    problem.reach = 0;
    for (int round = 0; round < 3; ++round) {
        run_on(problem, k_last_steps, goes_on, found);
        const std::vector<bool> kept = kept_planes(found.fit, mesh_planes(found), true);
        if (std::count(kept.begin(), kept.end(), false) == 0) break;
        keep(kept, problem, found);
    }
    return found;
}

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

// The rigid motion that brings what was fitted back to the mesh: its place, and up as it was.
FrameMotion to_mesh_frame(const Stone& mesh, const SilhouetteStart& start, const Found& found) {
    if (start.in_mesh_frame) return {};
    FrameMotion back = inverse(start.from_mesh.motion);
    Vec3 middle(0), mine(0);
    for (const Vec3& v : mesh.solid.vertices) middle += v / double(mesh.solid.vertices.size());
    const int up = mesh.up_facet.empty() ? -1 : find_facet(mesh.solid, mesh.up_facet);
    for (std::size_t p = 0; p < found.fit.planes.size(); ++p) {
        if (up < 0 || found.mesh_facet[p] != up) continue;
        // The smallest turn that brings the up facet's normal where it was.
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

// The stone in the mesh's place, facets named.
Stone named_stone(const Stone& mesh, const Found& found, const FrameMotion& back) {
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
            "facets of the outlines come and go by rounding: the outlines are of no "
            "stone with these facets");
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

}  // namespace

SilhouetteFit fit_silhouettes(const Stone& mesh, const Sets& sets,
                              const std::function<void()>& goes_on) {
    if (!mesh.convex) {
        throw InputError(
            "outlines show a convex stone only: take `convex = false` or the "
            "[[silhouette]] tables out of the stone file");
    }
    SilhouetteStart start = silhouette_start(mesh, sets);
    const Found found = find_planes(
        start.problem, goes_on ? goes_on : [] {});
    SilhouetteFit result;
    const FrameMotion back = to_mesh_frame(mesh, start, found);
    result.stone = named_stone(mesh, found, back);

    FrameHolds holds;
    holds.up = up_of(result.stone);
    holds.tilts = start.in_mesh_frame && mesh.up_facet.empty();
    holds.turn = start.in_mesh_frame && mesh.azimuth_from_mesh;
    const PlaneInformation information = plane_information(start.problem, found.fit);
    ToldPlanes told =
        told_planes(found.fit.planes, information.matrix, start.problem.width, back, holds);
    auto knowledge = std::make_shared<OutlineKnowledge>();
    for (const Facet& facet : result.stone.solid.facets) knowledge->planes.push_back(facet.plane);
    knowledge->rows = std::move(told.rows);
    knowledge->chi2 = information.chi2;
    knowledge->dof = information.chi2_dof;
    for (std::size_t s = 0; s < sets.size(); ++s) {
        knowledge->motions.push_back(product(back, found.fit.motions[s]));
        knowledge->sigmas.push_back(information.sigmas[s]);
        knowledge->estimated.push_back(!(start.problem.stated_sigmas[s] > 0));
    }
    result.knowledge = std::move(knowledge);

    std::vector<std::string> names;
    for (const int f : found.lost) names.push_back(mesh.solid.facets[std::size_t(f)].name);
    if (!names.empty()) {
        result.notes.push_back("the outlines leave no room for the mesh's facets " +
                               list_of(names) + ": they are left out");
    }
    names.clear();
    for (const int p : told.unseen) {
        names.push_back(result.stone.solid.facets[std::size_t(p)].name);
    }
    if (!names.empty()) {
        result.notes.push_back("the outlines hardly tell how these facets lie: " + list_of(names));
    }
    const std::size_t added = result.stone.solid.facets.size() - mesh_planes(found);
    if (added > 0) {
        result.notes.push_back(
            fmt::format("the outlines show {} facet{} more than the mesh has, most of them where "
                        "it has few for "
                        "a round girdle: named after the nearest facet",
                        added, added == 1 ? "" : "s"));
    }
    return result;
}

SilhouetteMisfit silhouette_misfit(const Solid& solid, const std::vector<Contour>& fitted,
                                   const std::vector<Contour>& contours,
                                   const FrameMotion& motion) {
    const Similarity start{inverse(motion), 1};
    const Similarity at = registered(solid.vertices, flattened(fitted, 0), start, {});
    std::vector<Vec3> corners;
    for (const Vec3& v : solid.vertices) corners.push_back(at.placed(v));
    const std::vector<FlatContour> flat = flattened(contours, 0);
    const std::vector<FrameMotion> same(1);
    return misfit_of(outline_distances(corners, flat, same), flat, 0);
}

FrameMotion found_motion(const Solid& solid, const Vec3& up, const std::vector<Contour>& contours) {
    return inverse(found_registration(solid.vertices, up, flattened(contours, 0)).motion);
}

}  // namespace culet
