#include "fit/starts/refit.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "fit/model/azimuth_turn.h"
#include "fit/model/orbits.h"
#include "fit/solve/caliper_turn.h"
#include "fit/uncertainty/statistics.h"
#include "stone/upright.h"

namespace culet {

namespace {

// The point nearest to the planes of a corner; in directions that they leave open, at `guess`.
Vec3 meet_of(const std::vector<Plane>& planes, const Vec3& guess) {
    glm::dmat3 normals(0.0);
    Vec3 right(0);
    for (const Plane& plane : planes) {
        normals += glm::outerProduct(plane.normal, plane.normal);
        right += (plane.offset - glm::dot(plane.normal, guess)) * plane.normal;
    }
    normals += glm::dmat3(1e-9);
    return guess + glm::inverse(normals) * right;
}

}  // namespace

Candidate finish_from(const FitModel& model, const Shape& shape, int iterations) {
    const Parameters parameters = model.parameters();
    Relaxation relaxation(model, parameters);
    Candidate candidate = finish_candidate(model, relaxation, parameters.symmetrised(shape),
                                           {.iterations = iterations});
    candidate.start = "last result";
    return candidate;
}

Candidate refit_from(const FitModel& model, const Shape& shape, int iterations) {
    const Parameters parameters = model.parameters();
    Relaxation relaxation(model, parameters);
    // Lower bound of the redundancy, by counting.
    const Relaxation::Counts counts = relaxation.counts();
    const double good_chi2 =
        chi2_quantile(k_minima.agrees_well, std::max(1, counts.soft - counts.free));
    Candidate candidate = finish_candidate(
        model, relaxation, turned_to_calipers(relaxation, parameters.symmetrised(shape)),
        {.iterations = iterations, .good_chi2 = good_chi2});
    candidate.start = "earlier result";
    return candidate;
}

std::optional<Shape> shape_of(const FitModel& model, const Solid& solid) {
    Shape shape = model.mesh_shape();
    const std::vector<Facet>& mesh = model.stone().solid.facets;
    std::vector<Plane> planes;
    for (const Facet& facet : mesh) {
        const int there = find_facet(solid, facet.name);
        if (there < 0) return std::nullopt;
        planes.push_back(solid.facets[std::size_t(there)].plane);
    }
    Vec3 mean(0);
    for (const Vec3& v : solid.vertices) mean += v / double(solid.vertices.size());
    for (Plane& plane : planes) {
        plane.offset = (plane.offset - glm::dot(plane.normal, mean)) / model.frame().scale();
    }

    const int up = model.frame().up_facet();
    glm::dmat3 turn =
        turn_upright(up >= 0 ? planes[std::size_t(up)].normal : glm::normalize(model.stone().up));
    // Azimuth: as most facets of the mesh stand, then as the azimuths read say.
    double east = 0, north = 0;
    for (std::size_t f = 0; f < planes.size(); ++f) {
        const Vec3 n = turn * planes[f].normal;
        const Vec3& m = shape.normals[f];
        east += n.x * m.x + n.y * m.y;
        north += n.x * m.y - n.y * m.x;
    }
    if (east != 0 || north != 0) turn = turn_about_z(std::atan2(north, east)) * turn;
    if (!model.stone().azimuth_from_mesh) {
        turn = turn_about_z(azimuth_turn(
                   model.readings(),
                   [&](int facet) { return turn * planes[std::size_t(facet)].normal; }, false)) *
               turn;
    }
    for (std::size_t f = 0; f < planes.size(); ++f) {
        planes[f].normal = glm::normalize(turn * planes[f].normal);
        shape.normals[f] = planes[f].normal;
        shape.offsets[f] = planes[f].offset;
    }
    if (up >= 0) shape.normals[std::size_t(up)] = Vec3{0, 0, 1};
    std::vector<std::vector<Plane>> of_point(shape.points.size());
    for (const Incidence& incidence : model.meets().incidences) {
        of_point[std::size_t(incidence.point)].push_back(planes[std::size_t(incidence.facet)]);
    }
    for (std::size_t p = 0; p < shape.points.size(); ++p) {
        shape.points[p] = meet_of(of_point[p], shape.points[p]);
    }
    return shape;
}

}  // namespace culet
