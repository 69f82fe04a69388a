#include "fit/model/enclosed.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "fit/model/constants.h"

namespace culet {

namespace {

// The three of these planes that cross most nearly at right angles.
std::array<int, 3> squarest(const Shape& shape, const std::vector<int>& planes) {
    std::array<int, 3> best{planes[0], planes[1], planes[2]};
    double most = -1;
    for (std::size_t i = 0; i < planes.size(); ++i) {
        for (std::size_t j = i + 1; j < planes.size(); ++j) {
            for (std::size_t k = j + 1; k < planes.size(); ++k) {
                const double det = std::abs(
                    glm::dot(shape.normals[planes[i]],
                             glm::cross(shape.normals[planes[j]], shape.normals[planes[k]])));
                if (det > most) {
                    most = det;
                    best = {planes[i], planes[j], planes[k]};
                }
            }
        }
    }
    return best;
}

}  // namespace

Enclosed enclosed_by(const FitModel& model, const Shape& shape) {
    const std::vector<Facet>& facets = model.frame().solid().facets;
    const HalfEdges& edges = model.edges();
    std::vector<NamedPlane> planes;
    for (std::size_t f = 0; f < shape.normals.size(); ++f) {
        planes.push_back({facets[f].name, {shape.normals[f], shape.offsets[f]}});
    }
    Enclosed result;
    HalfSpaceSolid cut = intersect_half_spaces(planes);
    auto outline = std::make_shared<Outline>();
    outline->loops.resize(planes.size());
    if (!cut.bounded || cut.empty) {
        result.outline = outline;
        for (const NamedPlane& plane : planes) result.missing.push_back(plane.name);
        return result;
    }
    ContractedSolid tidy = contract_near_meets(cut.solid, k_shapes.rounding_edge);
    result.solid = std::move(tidy.solid);
    result.closed = true;

    std::vector<int> facet_of(result.solid.facets.size());
    std::vector<std::vector<int>> planes_of(result.solid.vertices.size());
    std::vector<bool> present(planes.size(), false);
    for (std::size_t i = 0; i < result.solid.facets.size(); ++i) {
        const Facet& facet = result.solid.facets[i];
        int f = 0;
        while (facets[f].name != facet.name) ++f;
        facet_of[i] = f;
        present[f] = true;
        outline->loops[f] = facet.corners;
        for (int corner : facet.corners) planes_of[corner].push_back(f);
    }
    for (std::size_t f = 0; f < planes.size(); ++f) {
        if (!present[f]) result.missing.push_back(planes[f].name);
    }

    // A corner at a point whose incidences are all exact is that point.
    std::vector<bool> exact(shape.points.size(), true);
    for (const Incidence& incidence : model.meets().incidences) {
        if (incidence.how != MeetTreatment::exact) exact[incidence.point] = false;
    }
    for (std::size_t v = 0; v < planes_of.size(); ++v) {
        Corner corner;
        for (std::size_t p = 0; p < edges.facets_of_vertex.size() && corner.point < 0; ++p) {
            if (!exact[p] || glm::length(shape.points[p] - result.solid.vertices[v]) >
                                 10 * k_shapes.rounding_edge) {
                continue;
            }
            corner.point = static_cast<int>(p);
        }
        if (corner.point < 0 && planes_of[v].size() >= 3) {
            corner.planes = squarest(shape, planes_of[v]);
        }
        outline->corners.push_back(corner);
    }
    result.outline = outline;
    return result;
}

Solid met_solid(const FitModel& model, const Shape& shape) {
    Solid solid = model.frame().solid();
    for (std::size_t v = 0; v < solid.vertices.size(); ++v) solid.vertices[v] = shape.points[v];
    for (std::size_t f = 0; f < solid.facets.size(); ++f) {
        solid.facets[f].plane = {shape.normals[f], shape.offsets[f]};
    }
    return solid;
}

std::vector<std::pair<int, int>> hinges_of(const FitModel& model) {
    const std::vector<Facet>& facets = model.frame().solid().facets;
    std::vector<std::pair<int, int>> all;
    if (!model.stone().convex) return all;
    for (std::size_t f = 0; f < facets.size(); ++f) {
        const std::vector<int>& own = facets[f].corners;
        std::vector<int> near;
        for (int corner : own) {
            for (int g : model.edges().facets_of_vertex[corner]) {
                for (int c : facets[g].corners) near.push_back(c);
            }
        }
        std::sort(near.begin(), near.end());
        near.erase(std::unique(near.begin(), near.end()), near.end());
        for (int c : near) {
            if (std::find(own.begin(), own.end(), c) == own.end()) all.emplace_back(int(f), c);
        }
    }
    return all;
}

}  // namespace culet
