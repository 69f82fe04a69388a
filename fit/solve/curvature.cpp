// Second derivatives of the equations for fast final convergence: without them parameters that the
// readings hold weakly converge slowly.

#include <cmath>
#include <glm/geometric.hpp>

#include "fit/model/equations.h"
#include "fit/solve/relaxation.h"

namespace culet {

namespace {

// The edge l = d . (to - from) runs along the unit vector d = left x right / |left x right|. Where
// both corners lie on both planes, to - from = l d, and the second derivative by two parameters i,
// k is d_i . e_k + d_k . e_i - l d_i . d_k, where d_i and e_i are the derivatives of d and of to -
// from.
template <typename Add>
void add_edge_hessian(const Quantity& length, const Shape& shape,
                      const Parameters::TangentBasis& tangent_basis, double multiplier, Add add) {
    if (length.slopes.size() != 4 || length.slopes[3].by != Quantity::By::normal) return;
    const int to = length.slopes[0].index, from = length.slopes[1].index,
              left = length.slopes[2].index, right = length.slopes[3].index;
    const Vec3 &l = shape.normals[left], &r = shape.normals[right], &d = length.slopes[0].slope;
    const double sine = glm::length(glm::cross(l, r));
    struct Freedom {
        int column;
        Vec3 direction, edge;
    };
    std::array<Freedom, 12> parameters{};
    std::size_t count = 0;
    const auto turning = [&](int facet, const auto& change) {
        const Parameters::Slots& slots = tangent_basis.normals[facet];
        for (int k = 0; k < slots.count; ++k) {
            const Vec3 turned = change(slots.along[std::size_t(k)]) / sine;
            parameters[count++] = {slots.column + k, turned - glm::dot(turned, d) * d, Vec3(0)};
        }
    };
    turning(left, [&](const Vec3& v) { return glm::cross(v, r); });
    turning(right, [&](const Vec3& v) { return glm::cross(l, v); });
    const auto moving = [&](int point, double sign) {
        const Parameters::Slots& slots = tangent_basis.points[point];
        for (int k = 0; k < slots.count; ++k) {
            parameters[count++] = {slots.column + k, Vec3(0), sign * slots.along[std::size_t(k)]};
        }
    };
    moving(to, 1);
    moving(from, -1);
    for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t k = 0; k < count; ++k) {
            const Freedom &a = parameters[i], &b = parameters[k];
            if (a.column < b.column) continue;
            add(a.column, b.column,
                multiplier * (glm::dot(a.direction, b.edge) + glm::dot(b.direction, a.edge) -
                              length.value * glm::dot(a.direction, b.direction)));
        }
    }
}

// The second derivative of a distance l between corners is e_i . e_k / l, for steps across it.
template <typename Add>
void add_distance_hessian(const Quantity& length, const Parameters::TangentBasis& tangent_basis,
                          double multiplier, Add add) {
    if (length.slopes.size() != 2 || !(length.value > 0)) return;
    struct Freedom {
        int column;
        Vec3 across;
    };
    std::array<Freedom, 6> parameters{};
    std::size_t count = 0;
    const Vec3& along = length.slopes[0].slope;
    for (std::size_t end = 0; end < 2; ++end) {
        if (length.slopes[end].by != Quantity::By::point) return;
        const Parameters::Slots& slots = tangent_basis.points[length.slopes[end].index];
        for (int k = 0; k < slots.count; ++k) {
            const Vec3& step = slots.along[std::size_t(k)];
            const Vec3 across = step - glm::dot(step, along) * along;
            parameters[count++] = {slots.column + k, end == 0 ? across : -across};
        }
    }
    for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t k = 0; k < count; ++k) {
            const Freedom &a = parameters[i], &b = parameters[k];
            if (a.column < b.column) continue;
            add(a.column, b.column, multiplier * glm::dot(a.across, b.across) / length.value);
        }
    }
}

}  // namespace

std::vector<SymmetricEntry> Relaxation::curvature(const Shape& shape,
                                                  const Eigen::VectorXd& multipliers) const {
    // multiplier * (normal . point - offset): mixed derivatives of tilts and points, and the
    // second-order turn of the normal.
    std::vector<SymmetricEntry> entries;
    const Parameters::TangentBasis tangent_basis = parameters_.tangent_basis(shape);
    for (std::size_t i = 0; i < incidences_.size(); ++i) {
        const OrbitPair& incidence = incidences_[i];
        const double multiplier = multipliers(Eigen::Index(i));
        const Parameters::Slots &n = tangent_basis.normals[incidence.facet],
                                &x = tangent_basis.points[incidence.point];
        const double out = glm::dot(shape.normals[incidence.facet], shape.points[incidence.point]);
        for (int a = 0; a < n.count; ++a) {
            entries.push_back({n.column + a, n.column + a, -multiplier * out});
            for (int b = 0; b < x.count; ++b) {
                const int row = std::max(n.column + a, x.column + b),
                          column = std::min(n.column + a, x.column + b);
                entries.push_back(
                    {row, column,
                     multiplier * glm::dot(n.along[std::size_t(a)], x.along[std::size_t(b)])});
            }
        }
    }
    const auto add = [&](int a, int b, double value) {
        entries.push_back({std::max(a, b), std::min(a, b), value});
    };
    for (std::size_t i = 0; i < equations_.size(); ++i) {
        const Equation& e = equations_[i];
        const double multiplier = multipliers(Eigen::Index(incidences_.size() + i));
        if (e.reading < 0) continue;  // of the prior
        const Reading& reading = model_.readings()[std::size_t(e.reading)];
        if (reading.aggregate != Aggregate::single) continue;
        if (reading.kind == ReadingKind::inclination && reading.datum.kind == Datum::Kind::up) {
            const int f = reading.facets[0];
            const Parameters::Slots& n = tangent_basis.normals[f];
            const Vec3& normal = shape.normals[f];
            const double flat = std::hypot(normal.x, normal.y);
            if (n.count != 2 || flat < 1e-3) continue;
            // For a step across, the angle from z has the second derivative cot(angle).
            const Vec3 across{-normal.y / flat, normal.x / flat, 0};
            const Quantity q = e.formula(shape);
            const double side = q.slopes.empty() || q.slopes[0].slope.z <= 0 ? 1 : -1;
            const double bend = multiplier * side * normal.z / flat;
            for (int a = 0; a < 2; ++a) {
                for (int b = 0; b <= a; ++b) {
                    add(n.column + a, n.column + b,
                        bend * glm::dot(across, n.along[std::size_t(a)]) *
                            glm::dot(across, n.along[std::size_t(b)]));
                }
            }
        } else if (reading.kind == ReadingKind::edge) {
            const Quantity length = e.formula(shape);
            add_edge_hessian(length, shape, tangent_basis, multiplier, add);
            add_distance_hessian(length, tangent_basis, multiplier, add);
        }
    }
    return entries;
}

}  // namespace culet
