#include "tests/hard/exact_solid.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <vector>

#include "tests/render/oracle_numbers.h"

namespace culet::hard {

namespace {

// Vectors are std::arrays, so their operators must be named.
using oracle::operator+;
using oracle::operator-;
using oracle::operator*;
using oracle::Real;
using oracle::RealVec;

struct ExactPlane {
    RealVec normal;
    Real offset;
};

ExactPlane exact(const Plane& plane) {
    return {oracle::exact(plane.normal), Real(plane.offset)};
}

// Cramer's rule in 100 digits, for three planes with a non-zero determinant.
bool meet(const ExactPlane& a, const ExactPlane& b, const ExactPlane& c, RealVec& point) {
    const RealVec bc = oracle::cross(b.normal, c.normal);
    const Real determinant = oracle::dot(a.normal, bc);
    if (abs(determinant) < Real("1e-60")) return false;
    const RealVec ca = oracle::cross(c.normal, a.normal), ab = oracle::cross(a.normal, b.normal);
    const Real one = 1 / determinant;
    point = one * (a.offset * bc + (b.offset * ca + c.offset * ab));
    return true;
}

}  // namespace

ExactJudgement judge_solid(std::span<const NamedPlane> planes, const Solid& solid) {
    ExactJudgement judgement;
    std::vector<std::vector<int>> sharers(solid.vertices.size());
    for (std::size_t f = 0; f < solid.facets.size(); ++f) {
        for (const int corner : solid.facets[f].corners) {
            sharers[static_cast<std::size_t>(corner)].push_back(static_cast<int>(f));
        }
    }
    const double size = std::max(diameter(solid), 1e-300);
    double reach = size;
    for (const NamedPlane& p : planes) reach = std::max(reach, std::abs(p.plane.offset));
    std::vector<RealVec> vertices;
    for (std::size_t v = 0; v < solid.vertices.size(); ++v) {
        const std::vector<int>& of = sharers[v];
        RealVec point;
        bool found = false;
        for (std::size_t k = 2; k < of.size() && !found; ++k) {
            const auto plane = [&](std::size_t i) {
                return exact(solid.facets[static_cast<std::size_t>(of[i])].plane);
            };
            found = meet(plane(0), plane(k - 1), plane(k), point);
        }
        if (!found) {
            ++judgement.misplaced;
            vertices.push_back(oracle::exact(solid.vertices[v]));
            continue;
        }
        vertices.push_back(point);
        judgement.vertex_error =
            std::max(judgement.vertex_error,
                     glm::length(oracle::rounded(point - oracle::exact(solid.vertices[v]))));
        for (const NamedPlane& p : planes) {
            // A point far below is far below in doubles too.
            if (height_above(p.plane, solid.vertices[v]) < -1e-9 * reach) continue;
            const ExactPlane q = exact(p.plane);
            if (oracle::dot(q.normal, point) - q.offset > Real("1e-70") * Real(reach)) {
                ++judgement.misplaced;
                break;
            }
        }
    }
    Real six = 0;
    double surface = 0;
    for (const Facet& facet : solid.facets) {
        surface += area(solid, facet);
        for (std::size_t i = 1; i + 1 < facet.corners.size(); ++i) {
            const auto at = [&](std::size_t k) {
                return vertices[static_cast<std::size_t>(facet.corners[k])] - vertices[0];
            };
            six += oracle::dot(at(0), oracle::cross(at(i), at(i + 1)));
        }
    }
    const Real exact_volume = six / 6;
    judgement.volume = static_cast<double>(exact_volume);
    judgement.volume_error =
        static_cast<double>(abs(Real(volume(solid)) - exact_volume) / abs(exact_volume));
    judgement.volume_condition = surface * reach / judgement.volume;
    return judgement;
}

}  // namespace culet::hard
