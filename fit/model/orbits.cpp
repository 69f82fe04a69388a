#include "fit/model/orbits.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace culet {

namespace {

double largest(const glm::dmat3& m) {
    double most = 0;
    for (int c = 0; c < 3; ++c) {
        for (int r = 0; r < 3; ++r) most = std::max(most, std::abs(m[c][r]));
    }
    return most;
}

// Narrows the kept directions by one more motion that maps the thing to itself.
void narrow(KeptDirections& kept, const glm::dmat3& motion) {
    if (largest(motion - glm::dmat3(1.0)) < 1e-9 || kept.kind == KeptDirections::Kind::axis) return;
    if (glm::determinant(motion) > 0) {
        kept.kind = KeptDirections::Kind::axis;
        return;
    }
    // Level direction within a mirror plane: half the angle to the image of x.
    const double angle = 0.5 * std::atan2(motion[0][1], motion[0][0]);
    const Vec3 outward{std::cos(angle), std::sin(angle), 0};
    if (kept.kind == KeptDirections::Kind::all) {
        kept = {KeptDirections::Kind::vertical_plane, outward};
    } else if (std::abs(glm::cross(kept.outward, outward).z) > 1e-9) {
        kept.kind = KeptDirections::Kind::axis;
    }
}

struct Spread {
    std::vector<OrbitMember> members;
    std::vector<KeptDirections> kept;
};

template <typename Image>
Spread spread(const std::vector<SymmetryMotion>& generators, int count, Image image) {
    Spread result;
    result.members.resize(std::size_t(count));
    result.kept.resize(std::size_t(count));
    for (int first = 0; first < count; ++first) {
        if (result.members[first].first >= 0) continue;
        result.members[first].first = first;
        std::vector<int> queue{first};
        for (std::size_t q = 0; q < queue.size(); ++q) {
            const int at = queue[q];
            for (const SymmetryMotion& g : generators) {
                const int to = image(g, at);
                const glm::dmat3 map = g.motion * result.members[at].from_first;
                if (result.members[to].first < 0) {
                    result.members[to] = {first, map};
                    queue.push_back(to);
                } else {
                    narrow(result.kept[first], glm::transpose(result.members[to].from_first) * map);
                }
            }
        }
    }
    return result;
}

}  // namespace

glm::dmat3 turn_about_z(double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    return {Vec3{c, s, 0}, Vec3{-s, c, 0}, Vec3{0, 0, 1}};
}

Shape turned_about_z(Shape shape, double angle) {
    const glm::dmat3 turn = turn_about_z(angle);
    for (Vec3& n : shape.normals) n = turn * n;
    for (Vec3& p : shape.points) p = turn * p;
    return shape;
}

glm::dmat3 mirroring_at(double azimuth) {
    const Vec3 m{std::cos(azimuth), std::sin(azimuth), 0};
    return glm::dmat3(1.0) - 2.0 * glm::outerProduct(m, m);
}

std::optional<Orbits> orbits_of(const std::vector<SymmetryMotion>& generators, int facets,
                                int points) {
    Orbits orbits;
    orbits.generators = generators;
    Spread of_facets = spread(generators, facets,
                              [](const SymmetryMotion& g, int f) { return g.exchange.facets[f]; });
    Spread of_points = spread(
        generators, points, [](const SymmetryMotion& g, int p) { return g.exchange.vertices[p]; });
    // The axis of a convex stone crosses at most two facets or corners, one above and one below.
    int on_axis = 0;
    for (int f = 0; f < facets; ++f) {
        on_axis +=
            of_facets.members[f].first == f && of_facets.kept[f].kind == KeptDirections::Kind::axis;
    }
    for (int p = 0; p < points; ++p) {
        on_axis +=
            of_points.members[p].first == p && of_points.kept[p].kind == KeptDirections::Kind::axis;
    }
    if (on_axis > 2) return std::nullopt;
    orbits.facets = std::move(of_facets.members);
    orbits.points = std::move(of_points.members);
    orbits.kept_by_facet = std::move(of_facets.kept);
    orbits.kept_by_point = std::move(of_points.kept);
    return orbits;
}

}  // namespace culet
