#include "fit/relaxation.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>

namespace culet {

namespace {

// A hand-made mesh is off by as much as 20 % of its width.
constexpr double k_mesh_sigma = 0.4;
// Corners that want to stand above a neighbour facet are held this far below it, in half diameters:
// far above rounding, far below anything one could measure.
constexpr double k_hold_below = 1e-7;
// About so far: an edge that would turn over asks its two ends to be held, which one length of the
// edge can do but about.
constexpr double k_hold_sigma = 1e-8;
// Corners that share a caliper's jaw are level to this part of the half diameter.
constexpr double k_tie_sigma = 1e-6;

// One pair of facet and point of each orbit, and how many go with it.
class OrbitPairs {
public:
    explicit OrbitPairs(const Freedoms& freedoms) : generators_(freedoms.orbits().generators) {}

    /// 0: seen before; else the size of the pair's orbit.
    int take(int facet, int point) {
        if (generators_.empty()) return 1;
        if (!seen_.emplace(std::make_pair(facet, point), true).second) return 0;
        std::vector<std::pair<int, int>> queue{{facet, point}};
        for (std::size_t q = 0; q < queue.size(); ++q) {
            for (const SymmetryMotion& g : generators_) {
                const std::pair<int, int> to{g.exchange.facets[queue[q].first],
                                             g.exchange.vertices[queue[q].second]};
                if (seen_.emplace(to, true).second) queue.push_back(to);
            }
        }
        return static_cast<int>(queue.size());
    }

private:
    const std::vector<SymmetryMotion>& generators_;
    std::map<std::pair<int, int>, bool> seen_;
};

}  // namespace

Relaxation::Relaxation(const System& system, const Freedoms& freedoms)
    : system_(system), freedoms_(freedoms) {
    OrbitPairs incident(freedoms), hinged(freedoms);
    for (std::size_t i = 0; i < system.incidences().size(); ++i) {
        const Incidence& incidence = system.incidences()[i];
        if (const int images = incident.take(incidence.facet, incidence.point)) {
            incidences_.push_back(static_cast<int>(i));
            incidence_images_.push_back(images);
        }
    }
    choose(system.mesh_shape());
    if (!system.stone().convex) return;
    const std::vector<Facet>& facets = system.stone().solid.facets;
    const std::size_t points = system.mesh_shape().points.size();
    std::vector<int> mark(points, -1);
    for (std::size_t f = 0; f < facets.size(); ++f) {
        const int own = static_cast<int>(f);
        for (int corner : facets[f].corners) mark[corner] = own;
        std::vector<int> near;
        for (int corner : facets[f].corners) {
            for (int g : system.edges().facets_of_vertex[corner]) {
                for (int c : facets[g].corners) {
                    if (mark[c] == own) continue;
                    mark[c] = own;
                    near.push_back(c);
                }
            }
        }
        std::sort(near.begin(), near.end());
        for (int c : near) {
            if (const int images = hinged.take(own, c)) {
                hinges_.emplace_back(own, c);
                hinge_images_.push_back(images);
            }
        }
    }
    was_positive_.assign(hinges_.size(), false);
}

void Relaxation::choose(const Shape& shape) {
    std::vector<Equation> before = std::move(equations_);
    equations_ = system_.reading_equations(shape, system_.mesh_outline(), true);
    if (before.size() != equations_.size()) return;
    for (std::size_t i = 0; i < before.size(); ++i) {
        const Equation &was = before[i], &is = equations_[i];
        if (is.caliper == Vec3(0)) continue;
        for (int jaw = 0; jaw < 2; ++jaw) {
            const int from = was.touched[std::size_t(jaw)].point,
                      to = is.touched[std::size_t(jaw)].point;
            if (from < 0 || to < 0 || from == to) continue;
            std::vector<int>& left = left_[{static_cast<int>(i), jaw}];
            if (std::find(left.begin(), left.end(), to) != left.end()) {
                ties_.push_back({from, to, is.caliper});
                left.clear();
            } else {
                left.push_back(from);
            }
        }
    }
}

double Relaxation::height(const Shape& shape, int facet, int point) const {
    return glm::dot(shape.normals[facet], shape.points[point]) - shape.offsets[facet];
}

Relaxation::Counts Relaxation::counts() const {
    Counts counts;
    for (int i : incidences_) {
        const MeetTreatment how = system_.incidences()[i].how;
        counts.hard += how == MeetTreatment::exact;
        counts.soft += how == MeetTreatment::soft;
    }
    for (const Equation& e : equations_) ++(e.exact ? counts.hard : counts.soft);
    return counts;
}

Eigen::VectorXd Relaxation::metric() const {
    const std::vector<double>& m = freedoms_.metric();
    return Eigen::Map<const Eigen::VectorXd>(m.data(), Eigen::Index(m.size()));
}

std::vector<Held> Relaxation::above(const Shape& shape) const {
    std::vector<Held> result;
    for (const auto& [f, p] : hinges_) {
        if (height(shape, f, p) > 0) result.push_back({f, p});
    }
    return result;
}

Sheet Relaxation::sheet(const Shape& shape, const Softness& softness,
                        const std::vector<Held>& held) {
    Sheet sheet;
    const Freedoms::Chart chart = freedoms_.chart(shape);
    const int size = freedoms_.size();
    Freedoms::Row row(chart, size);
    const auto incident = [&](int f, int p) {
        row.normal(f, shape.points[p]);
        row.offset(f, -1);
        row.point(p, shape.normals[f]);
    };
    const auto close = [&](double residual, double variance) {
        row.close(sheet.rows, residual, variance);
        if (!std::isfinite(residual)) sheet.finite = false;
        if (variance > 0) {
            sheet.merit += residual * residual / variance;
        } else {
            sheet.hard_sum += std::abs(residual);
            sheet.hard_worst = std::max(sheet.hard_worst, std::abs(residual));
        }
    };
    const double soft2 = softness.incidence * softness.incidence;
    for (std::size_t i = 0; i < incidences_.size(); ++i) {
        const Incidence& incidence = system_.incidences()[incidences_[i]];
        const double residual = height(shape, incidence.facet, incidence.point);
        incident(incidence.facet, incidence.point);
        const double own = system_.incidence_sigma(incidence);
        if (incidence.how == MeetTreatment::soft) {
            sheet.chi2 += incidence_images_[i] * residual * residual / (own * own);
        }
        close(residual, (own * own + soft2) / incidence_images_[i]);
    }
    if (softness.with_readings) {
        for (const Equation& e : equations_) {
            const Quantity q = e.formula(shape);
            const double residual = q.value - e.value;
            row.quantity(q);
            if (!e.exact) sheet.chi2 += residual * residual / (e.sigma * e.sigma);
            close(residual,
                  e.exact ? soft2 : e.sigma * e.sigma + softness.readings * softness.readings);
        }
    }
    for (const Held& h : held) {
        incident(h.facet, h.point);
        close(height(shape, h.facet, h.point) + k_hold_below, k_hold_sigma * k_hold_sigma);
    }
    for (const Tie& tie : ties_) {
        row.point(tie.one, tie.direction);
        row.point(tie.other, -tie.direction);
        close(glm::dot(tie.direction, shape.points[tie.one] - shape.points[tie.other]),
              k_tie_sigma * k_tie_sigma);
    }
    for (std::size_t i = 0; i < hinges_.size(); ++i) {
        const auto& [f, p] = hinges_[i];
        const double residual = height(shape, f, p);
        if (residual > 0) {
            was_positive_[i] = true;
            sheet.convex = false;
        }
        if (!was_positive_[i]) continue;
        if (std::find(held.begin(), held.end(), Held{f, p}) != held.end()) continue;
        if (residual > 0) {
            incident(f, p);
            close(residual, softness.hinge * softness.hinge / hinge_images_[i]);
        } else {
            // Keeps its place in the pattern and says nothing.
            row.normal(f, Vec3(0));
            row.offset(f, 0);
            row.point(p, Vec3(0));
            close(0, 1);
        }
    }
    sheet.prior_stiffness = Eigen::VectorXd::Zero(size);
    sheet.prior_gradient = Eigen::VectorXd::Zero(size);
    if (softness.with_priors) {
        const Shape& mesh = system_.mesh_shape();
        for (int p = 0; p < static_cast<int>(shape.points.size()); ++p) {
            const Freedoms::Slots& slots = chart.points[p];
            const Vec3 off = (shape.points[p] - mesh.points[p]) / (k_mesh_sigma * k_mesh_sigma);
            sheet.merit += glm::dot(off, shape.points[p] - mesh.points[p]);
            for (int k = 0; k < slots.count; ++k) {
                sheet.prior_stiffness(slots.column + k) += 1 / (k_mesh_sigma * k_mesh_sigma);
                sheet.prior_gradient(slots.column + k) +=
                    glm::dot(slots.along[std::size_t(k)], off);
            }
        }
    }
    if (!std::isfinite(sheet.merit)) sheet.finite = false;
    return sheet;
}

Sheet Relaxation::hard_sheet(const Shape& shape, const std::vector<Held>& held) const {
    Sheet sheet;
    const Freedoms::Chart chart = freedoms_.chart(shape);
    Freedoms::Row row(chart, freedoms_.size());
    const auto close = [&](double residual, double variance) {
        row.close(sheet.rows, residual, variance);
        if (!std::isfinite(residual)) sheet.finite = false;
        if (variance > 0) return;
        sheet.hard_sum += std::abs(residual);
        sheet.hard_worst = std::max(sheet.hard_worst, std::abs(residual));
    };
    const auto incident = [&](int f, int p, double below, double variance) {
        row.normal(f, shape.points[p]);
        row.offset(f, -1);
        row.point(p, shape.normals[f]);
        close(height(shape, f, p) + below, variance);
    };
    for (int i : incidences_) {
        const Incidence& incidence = system_.incidences()[i];
        if (incidence.how == MeetTreatment::exact) incident(incidence.facet, incidence.point, 0, 0);
    }
    if (system_.has_exact_readings()) {
        for (const Equation& e : equations_) {
            if (!e.exact) continue;
            const Quantity q = e.formula(shape);
            row.quantity(q);
            close(q.value - e.value, 0);
        }
    }
    for (const Held& h : held) {
        incident(h.facet, h.point, k_hold_below, k_hold_sigma * k_hold_sigma);
    }
    return sheet;
}

std::vector<Relaxation::Folded> Relaxation::folded(const Shape& shape, double within) const {
    std::vector<Folded> result;
    int row = static_cast<int>(incidences_.size());
    for (const Equation& e : equations_) {
        if (e.other_value && !e.exact) {
            const int f = system_.readings()[std::size_t(e.reading)].facets[0];
            if (std::abs(shape.normals[f].z) < within) {
                result.push_back({row, *e.other_value - e.value});
            }
        }
        ++row;
    }
    return result;
}

std::vector<SaddleSolver::Entry> Relaxation::curvature(const Shape& shape,
                                                       const Eigen::VectorXd& forces) const {
    // force * (normal . point - offset): mixed derivatives of tilts and points, and the turn of the
    // normal itself.
    std::vector<SaddleSolver::Entry> entries;
    const Freedoms::Chart chart = freedoms_.chart(shape);
    for (std::size_t i = 0; i < incidences_.size(); ++i) {
        const Incidence& incidence = system_.incidences()[incidences_[i]];
        const double force = forces(Eigen::Index(i));
        const Freedoms::Slots &n = chart.normals[incidence.facet],
                              &x = chart.points[incidence.point];
        const double out = glm::dot(shape.normals[incidence.facet], shape.points[incidence.point]);
        for (int a = 0; a < n.count; ++a) {
            entries.push_back({n.column + a, n.column + a, -force * out});
            for (int b = 0; b < x.count; ++b) {
                const int row = std::max(n.column + a, x.column + b),
                          column = std::min(n.column + a, x.column + b);
                entries.push_back(
                    {row, column,
                     force * glm::dot(n.along[std::size_t(a)], x.along[std::size_t(b)])});
            }
        }
    }
    const auto add = [&](int a, int b, double value) {
        entries.push_back({std::max(a, b), std::min(a, b), value});
    };
    for (std::size_t i = 0; i < equations_.size(); ++i) {
        const Equation& e = equations_[i];
        const double force = forces(Eigen::Index(incidences_.size() + i));
        const Reading& reading = system_.readings()[std::size_t(e.reading)];
        if (reading.aggregate != Aggregate::single) continue;
        if (reading.kind == ReadingKind::inclination && reading.datum.kind == Datum::Kind::up) {
            const int f = reading.facets[0];
            const Freedoms::Slots& n = chart.normals[f];
            const Vec3& normal = shape.normals[f];
            const double flat = std::hypot(normal.x, normal.y);
            if (n.count != 2 || flat < 1e-3) continue;
            // An angle from z grows by half its cotangent for a step across.
            const Vec3 across{-normal.y / flat, normal.x / flat, 0};
            const Quantity q = e.formula(shape);
            const double side = q.slopes.empty() || q.slopes[0].slope.z <= 0 ? 1 : -1;
            const double bend = force * side * normal.z / flat;
            for (int a = 0; a < 2; ++a) {
                for (int b = 0; b <= a; ++b) {
                    add(n.column + a, n.column + b,
                        bend * glm::dot(across, n.along[std::size_t(a)]) *
                            glm::dot(across, n.along[std::size_t(b)]));
                }
            }
        } else if (reading.kind == ReadingKind::edge) {
            const Quantity q = e.formula(shape);
            if (q.slopes.size() != 2 || !(q.value > 1e-6) || q.slopes[0].by != Quantity::By::point)
                continue;
            const Vec3 along = q.slopes[0].slope;
            const double bend = force / q.value;
            for (int one = 0; one < 2; ++one) {
                for (int other = 0; other < 2; ++other) {
                    const Freedoms::Slots &x = chart.points[q.slopes[std::size_t(one)].index],
                                          &y = chart.points[q.slopes[std::size_t(other)].index];
                    for (int a = 0; a < x.count; ++a) {
                        for (int b = 0; b < y.count; ++b) {
                            const int row = x.column + a, column = y.column + b;
                            if (row < column) continue;
                            const Vec3 &u = x.along[std::size_t(a)], &v = y.along[std::size_t(b)];
                            add(row, column,
                                (one == other ? bend : -bend) *
                                    (glm::dot(u, v) - glm::dot(u, along) * glm::dot(v, along)));
                        }
                    }
                }
            }
        }
    }
    return entries;
}

}  // namespace culet
