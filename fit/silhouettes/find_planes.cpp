#include "fit/silhouettes/find_planes.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "fit/silhouettes/missing_facets.h"
#include "stone/numbers/units.h"
#include "stone/numbers/upper_median.h"
#include "stone/text/errors.h"

namespace culet {

std::size_t mesh_planes(const FoundPlanes& found) {
    return std::size_t(std::count_if(found.mesh_facet.begin(), found.mesh_facet.end(),
                                     [](int f) { return f >= 0; }));
}

namespace {

// Part of the width: until the last steps, points further off do not count.
constexpr double k_reach = 0.01;
constexpr int k_first_steps = 40, k_round_steps = 8, k_last_steps = 30, k_rounds = 8;
// More than any stone's facets; the equations are dense in them.
constexpr std::size_t k_most_planes = 400;
// An added facet is dropped if it is narrower than this many robust scales of the outlines.
constexpr double k_narrow = 4;
const double k_alike = radians(6.0);
// Sigma of an added plane's tilt.
const double k_added_tilt = radians(2.0);

// Drops planes without a facet, and added ones that are too narrow.
std::vector<bool> kept_planes(const PlaneFit& fit, std::size_t of_mesh, bool at_the_end) {
    double scale = 0;
    for (const double s : fit.scales) scale = std::max(scale, s);
    std::vector<bool> kept = fit.body.present;
    for (const Facet& facet : fit.body.solid.facets) {
        const auto plane = std::size_t(std::stoi(facet.name));
        if (plane < of_mesh) continue;
        kept[plane] = narrow_width(fit.body.solid, facet) > k_narrow * scale;
    }
    // Before the end a facet of the mesh may come back.
    for (std::size_t p = 0; p < of_mesh && !at_the_end; ++p) kept[p] = true;
    return kept;
}

}  // namespace

std::optional<double> reach_along(const Vec3& normal, const PlaneFitProblem& problem,
                                  const Viewpoints& from) {
    constexpr double k_edge_on = 0.05;
    std::vector<double> reaches;
    for (std::size_t c = 0; c < problem.contours.size(); ++c) {
        const FlatContour& contour = problem.contours[c];
        const PlacedContour at = from.placed(problem.contours, c);
        if (std::abs(glm::dot(normal, glm::cross(at.across, at.along))) > k_edge_on) continue;
        const double x = glm::dot(normal, at.across), y = glm::dot(normal, at.along);
        double most = -1e300;
        for (const auto& p : contour.points) {
            most = std::max(most, x * (p[0] + at.dx) + y * (p[1] + at.dy));
        }
        reaches.push_back(most);
    }
    if (reaches.empty()) return std::nullopt;
    return upper_median(std::move(reaches));
}

namespace {

// Restarts a mesh facet that slid off the body where the outlines end; the up facet where it cuts
// off a little, if they extend beyond the body (a holder).
void restart_lost_facets(const Stone& mesh, PlaneFitProblem& problem, FoundPlanes& found) {
    constexpr double k_little = 0.02;  // of the width
    PlaneFit& fit = found.fit;
    for (std::size_t p = 0; p < fit.planes.size(); ++p) {
        if (fit.body.present[p] || found.mesh_facet[p] < 0) continue;
        const Vec3& normal = problem.start[p].normal;
        double support = -1e300;
        for (const Vec3& c : fit.body.corners) support = std::max(support, glm::dot(normal, c));
        std::optional<double> offset = reach_along(normal, problem, fit.from);
        if (!offset || *offset > support) offset.reset();
        const std::string& name = mesh.solid.facets[std::size_t(found.mesh_facet[p])].name;
        if (!offset && name == mesh.up_facet) offset = support - k_little * problem.width;
        if (offset) problem.start[p] = fit.planes[p] = {normal, *offset};
    }
}

// Uses a cut for a lost mesh facet of nearly the same direction.
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

// Continues from the last round; the prior stays at the original start.
void run_on(const PlaneFitProblem& problem, int steps, FoundPlanes& found) {
    PlaneFitProblem from_here = problem;
    from_here.from = found.fit.from;
    found.fit = fit_planes(from_here, found.fit.planes, steps);
    if (!found.fit.body.closed) {
        throw InputError(
            "the planes of the outlines enclose no stone: are they of this stone, and "
            "their directions along the line of sight?");
    }
}

// Renews body, distances and scales at once, because they refer to planes by number.
void keep(const std::vector<bool>& kept, PlaneFitProblem& problem, FoundPlanes& found) {
    std::vector<Plane> start, planes;
    std::vector<double> tilts;
    std::vector<int> facets;
    for (std::size_t p = 0; p < kept.size(); ++p) {
        if (!kept[p]) {
            if (found.mesh_facet[p] >= 0) found.lost.push_back(found.mesh_facet[p]);
            continue;
        }
        start.push_back(problem.start[p]);
        tilts.push_back(problem.start_tilts[p]);
        planes.push_back(found.fit.planes[p]);
        facets.push_back(found.mesh_facet[p]);
    }
    problem.start = std::move(start);
    problem.start_tilts = std::move(tilts);
    found.fit.planes = std::move(planes);
    found.mesh_facet = std::move(facets);
    run_on(problem, 0, found);
}

}  // namespace

FoundPlanes find_planes(const Stone& mesh, PlaneFitProblem& problem) {
    FoundPlanes found;
    for (std::size_t f = 0; f < problem.start.size(); ++f)
        found.mesh_facet.push_back(f < mesh.solid.facets.size() ? int(f) : -1);
    found.fit.planes = problem.start;
    found.fit.from = problem.from;
    problem.outliers.reach = k_reach * problem.width;
    run_on(problem, k_first_steps, found);
    for (int round = 0; round < k_rounds; ++round) {
        restart_lost_facets(mesh, problem, found);
        const std::size_t room = k_most_planes - std::min(k_most_planes, problem.start.size());
        const std::vector<Plane> more = missing_planes(problem, found.fit, room);
        if (more.empty()) break;
        for (const Plane& plane : more) {
            if (is_lost_facet(plane, problem, found.fit, mesh_planes(found))) continue;
            problem.start.push_back(plane);
            problem.start_tilts.push_back(k_added_tilt);
            found.fit.planes.push_back(plane);
            found.mesh_facet.push_back(-1);
        }
        run_on(problem, k_round_steps, found);
        keep(kept_planes(found.fit, mesh_planes(found), false), problem, found);
    }
    problem.outliers.reach = 0;
    restart_lost_facets(mesh, problem, found);
    // Every pass but the last drops planes.
    for (;;) {
        run_on(problem, k_last_steps, found);
        const std::vector<bool> kept = kept_planes(found.fit, mesh_planes(found), true);
        if (std::count(kept.begin(), kept.end(), false) == 0) return found;
        keep(kept, problem, found);
    }
}

}  // namespace culet
