#include "compare/refine/plane_moves.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "compare/scores/chance.h"

namespace culet {

std::vector<FacetMoves> moves_of(const Solid& solid) {
    const double reach = diameter(solid) / 4;
    std::vector<FacetMoves> all;
    for (const Facet& facet : solid.facets) {
        const Vec3& n = facet.plane.normal;
        const Vec3 away = std::abs(n.z) < 0.9 ? Vec3(0, 0, 1) : Vec3(1, 0, 0);
        const Vec3 u = glm::normalize(glm::cross(n, away));
        all.push_back({corner_mean(solid, facet), u, glm::cross(n, u), n, reach});
    }
    return all;
}

Plane moved_plane(const FacetMoves& facet, std::size_t move, double amount) {
    if (move == 2) {
        return {facet.normal, glm::dot(facet.normal, facet.middle) + amount * facet.reach};
    }
    const Vec3 normal = rotation_about(move == 0 ? facet.u : facet.v, amount) * facet.normal;
    return {normal, glm::dot(normal, facet.middle)};
}

std::optional<Solid> with_plane_moved(const Solid& solid, std::size_t facet, const FacetMoves& from,
                                      std::size_t move, double amount) {
    std::vector<NamedPlane> planes;
    for (const Facet& one : solid.facets) planes.push_back({one.name, one.plane});
    planes[facet].plane = moved_plane(from, move, amount);
    HalfSpaceSolid cut = intersect_half_spaces(planes);
    if (cut.empty || !cut.bounded) return std::nullopt;
    return std::move(cut.solid);
}

std::vector<double> moves_between(const Solid& from, const Solid& to) {
    std::vector<double> moves;
    const std::vector<FacetMoves> facets = moves_of(from);
    for (std::size_t f = 0; f < facets.size(); ++f) {
        const int there = find_facet(to, from.facets[f].name);
        if (there < 0) {
            moves.insert(moves.end(), k_moves_of_a_facet, 0.0);
            continue;
        }
        const FacetMoves& facet = facets[f];
        const Plane& plane = to.facets[std::size_t(there)].plane;
        // A rotation by a about u changes n by a u x n.
        moves.push_back(glm::dot(plane.normal, glm::cross(facet.u, facet.normal)));
        moves.push_back(glm::dot(plane.normal, glm::cross(facet.v, facet.normal)));
        moves.push_back((plane.offset - glm::dot(plane.normal, facet.middle)) / facet.reach);
    }
    return moves;
}

std::vector<std::vector<double>> moves_of_the_whole(const Solid& solid) {
    const std::vector<FacetMoves> facets = moves_of(solid);
    const Vec3 middle = centroid(solid);
    std::vector<std::vector<double>> whole(7);
    for (const FacetMoves& f : facets) {
        const Vec3 from_middle = f.middle - middle;
        for (int axis = 0; axis < 3; ++axis) {
            Vec3 along(0);
            along[axis] = 1;
            auto& shift = whole[std::size_t(axis)];
            shift.insert(shift.end(), {0, 0, glm::dot(f.normal, along) / f.reach});
            // The rotation also moves the facet's middle.
            auto& turn = whole[std::size_t(3 + axis)];
            turn.insert(turn.end(), {glm::dot(along, f.u), glm::dot(along, f.v),
                                     glm::dot(f.normal, glm::cross(along, from_middle)) / f.reach});
        }
        whole[6].insert(whole[6].end(), {0, 0, glm::dot(f.normal, from_middle) / f.reach});
    }
    return whole;
}

PlaneSlopes plane_slopes(const FacetMoves& facet, double by_u, double by_v, double by_shift) {
    // The shift of a plane with a rotating normal is dd - dn . middle.
    const double offset = by_shift / facet.reach;
    return {by_u * glm::cross(facet.u, facet.normal) + by_v * glm::cross(facet.v, facet.normal) -
                offset * (facet.middle - glm::dot(facet.middle, facet.normal) * facet.normal),
            offset};
}

}  // namespace culet
