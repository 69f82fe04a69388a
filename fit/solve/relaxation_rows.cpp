// The equations of a relaxation at a shape: as rows in the parameters, and as residuals for Ceres.

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "fit/solve/relaxation.h"
#include "fit/solve/relaxation_terms.h"

namespace culet {

StepLinearisation Relaxation::linearisation(const Shape& shape, const PenaltyScale& penalty,
                                            const std::vector<ActiveCorner>& held,
                                            const std::vector<int>* active_hinges) {
    StepLinearisation linearisation;
    linearisation.rows.reserve(most_rows_, most_entries_);
    const Parameters::TangentBasis tangent_basis = parameters_.tangent_basis(shape);
    const int size = parameters_.size();
    Parameters::Row row(tangent_basis, size);
    const auto incident = [&](int f, int p) {
        row.normal(f, shape.points[p]);
        row.offset(f, -1);
        row.point(p, shape.normals[f]);
    };
    const auto count_hard = [&](double residual) {
        linearisation.hard_sum += std::abs(residual);
        linearisation.hard_worst = std::max(linearisation.hard_worst, std::abs(residual));
    };
    const auto close = [&](double residual, double variance) {
        row.close(linearisation.rows, residual, variance);
        if (!std::isfinite(residual)) linearisation.finite = false;
        if (variance > 0) {
            linearisation.merit += residual * residual / variance;
        } else {
            count_hard(residual);
        }
    };
    const double soft2 = penalty.incidence * penalty.incidence;
    for (std::size_t i = 0; i < incidences_.size(); ++i) {
        const Incidence& incidence = system_.incidences()[incidences_[i]];
        const double residual = height(shape, incidence.facet, incidence.point);
        incident(incidence.facet, incidence.point);
        if (incidence.how == MeetTreatment::soft) {
            const double own = system_.incidence_sigma(incidence);
            linearisation.chi2 += incidence_images_[i] * residual * residual / (own * own);
        }
        close(residual, incidence_variance(i, penalty));
    }
    if (penalty.with_readings) {
        for (const Equation& e : equations_) {
            const Quantity q = misfit_of(e, shape, penalty);
            row.quantity(q);
            if (!e.exact) linearisation.chi2 += q.value * q.value / (e.sigma * e.sigma) + e.scatter;
            close(q.value, variance_of(e, penalty));
        }
    }
    const auto counts = [&](int hinge, bool is_above) {
        if (is_above) linearisation.above.push_back(hinge);
        return active_hinges
                   ? std::binary_search(active_hinges->begin(), active_hinges->end(), hinge)
                   : is_above;
    };
    // Hard but for what an edge's other end asks: squares of such weight would forbid every step
    // that bends.
    std::vector<int> held_hinges;
    linearisation.first_holding = linearisation.rows.count();
    for (const ActiveCorner& h : held) {
        held_hinges.push_back(hinge_of(h));
        const double residual = height(shape, h.facet, h.point) + k_hold_below;
        if (!std::isfinite(residual)) linearisation.finite = false;
        count_hard(std::max(0.0, residual));
        // What holds it brings it to its level; whether it still should, the force there tells.
        if (!counts(held_hinges.back(), residual > -k_at_level)) continue;
        incident(h.facet, h.point);
        row.close(linearisation.rows, residual, k_hold_sigma * k_hold_sigma);
        linearisation.holding.push_back(h);
        linearisation.holding_hinge.push_back(held_hinges.back());
    }
    std::sort(held_hinges.begin(), held_hinges.end());
    for (const SharedContact& tie : shared_contacts_) {
        row.point(tie.one, tie.direction);
        row.point(tie.other, -tie.direction);
        close(off_level(shape, tie), k_tie_sigma * k_tie_sigma + soft2);
    }
    for (int i = 0; i < static_cast<int>(hinges_.size()); ++i) {
        const auto& [f, p] = hinges_[std::size_t(i)];
        const double residual = height(shape, f, p);
        const double variance = penalty.hinge * penalty.hinge / hinge_images_[std::size_t(i)];
        if (!std::isfinite(residual)) linearisation.finite = false;
        if (std::binary_search(held_hinges.begin(), held_hinges.end(), i)) continue;
        if (residual > 0) linearisation.merit += residual * residual / variance;
        if (!counts(i, residual > 0)) continue;
        incident(f, p);
        row.close(linearisation.rows, residual, variance);
    }
    std::sort(linearisation.above.begin(), linearisation.above.end());
    most_rows_ = std::max(most_rows_, linearisation.rows.residual.size());
    most_entries_ = std::max(most_entries_, linearisation.rows.column.size());
    linearisation.prior_stiffness = Eigen::VectorXd::Zero(size);
    linearisation.prior_gradient = Eigen::VectorXd::Zero(size);
    if (penalty.with_priors) {
        const Shape& mesh = system_.mesh_shape();
        const double stiffness = 1 / (penalty.mesh_sigma * penalty.mesh_sigma);
        for (int p = 0; p < static_cast<int>(shape.points.size()); ++p) {
            const Parameters::Slots& slots = tangent_basis.points[p];
            const Vec3 off = (shape.points[p] - mesh.points[p]) * stiffness;
            linearisation.prior += glm::dot(off, shape.points[p] - mesh.points[p]);
            for (int k = 0; k < slots.count; ++k) {
                linearisation.prior_stiffness(slots.column + k) += stiffness;
                linearisation.prior_gradient(slots.column + k) +=
                    glm::dot(slots.along[std::size_t(k)], off);
            }
        }
    }
    linearisation.merit += linearisation.prior;
    if (!std::isfinite(linearisation.merit)) linearisation.finite = false;
    return linearisation;
}

std::vector<Relaxation::Residual> Relaxation::residuals(const PenaltyScale& penalty) const {
    std::vector<Residual> all;
    for (std::size_t i = 0; i < incidences_.size(); ++i) {
        const Incidence& incidence = system_.incidences()[std::size_t(incidences_[i])];
        all.push_back({culet::height(incidence.facet, Corner{incidence.point}),
                       std::sqrt(incidence_variance(i, penalty)), false});
    }
    for (const Equation& e : equations_) {
        if (!penalty.with_readings) break;
        all.push_back({[&e, &penalty](const Shape& shape) { return misfit_of(e, shape, penalty); },
                       std::sqrt(variance_of(e, penalty)),
                       !e.exact && e.role == Equation::Role::reading});
    }
    for (const SharedContact& tie : shared_contacts_) {
        all.push_back({extent(Corner{tie.one}, Corner{tie.other}, tie.direction),
                       std::hypot(k_tie_sigma, penalty.incidence), false});
    }
    for (const int p : points_) {
        if (!penalty.with_priors) break;
        const Vec3& drawn = system_.mesh_shape().points[std::size_t(p)];
        for (int k = 0; k < 3; ++k) {
            Vec3 axis(0);
            axis[k] = 1;
            all.push_back({point_component(p, axis, drawn[k]), penalty.mesh_sigma, false});
        }
    }
    return all;
}

Relaxation::Residual Relaxation::hinge(const ActiveCorner& corner,
                                       const PenaltyScale& penalty) const {
    const double images = hinge_images_[std::size_t(hinge_of(corner))];
    return {culet::height(corner.facet, Corner{corner.point}), penalty.hinge / std::sqrt(images),
            false};
}

Relaxation::Missed Relaxation::missed(const Shape& shape, const PenaltyScale& penalty,
                                      const std::vector<ActiveCorner>& holding,
                                      double sharp) const {
    Missed missed;
    const std::size_t readings = penalty.with_readings ? equations_.size() : 0;
    missed.residuals = Eigen::VectorXd::Zero(
        Eigen::Index(incidences_.size() + readings + holding.size() + shared_contacts_.size()));
    Eigen::Index row = 0;
    const auto put = [&](double residual, bool is_hard) {
        missed.residuals(row) = residual;
        if (is_hard && !(std::abs(residual) <= missed.worst)) missed.worst = std::abs(residual);
    };
    for (std::size_t i = 0; i < incidences_.size(); ++i, ++row) {
        const Incidence& incidence = system_.incidences()[incidences_[i]];
        const double variance = incidence_variance(i, penalty);
        if (variance < sharp) put(height(shape, incidence.facet, incidence.point), variance == 0);
    }
    for (std::size_t i = 0; i < readings; ++i, ++row) {
        const Equation& e = equations_[i];
        const double variance = variance_of(e, penalty);
        if (variance < sharp) put(e.formula(shape).value - e.value, variance == 0);
    }
    for (const ActiveCorner& h : holding) {
        put(height(shape, h.facet, h.point) + k_hold_below, true);
        ++row;
    }
    for (const SharedContact& tie : shared_contacts_) {
        put(off_level(shape, tie), false);
        ++row;
    }
    return missed;
}

StepLinearisation Relaxation::hard_linearisation(const Shape& shape,
                                                 const std::vector<ActiveCorner>& held) const {
    StepLinearisation linearisation;
    const Parameters::TangentBasis tangent_basis = parameters_.tangent_basis(shape);
    Parameters::Row row(tangent_basis, parameters_.size());
    const auto close = [&](double residual, double variance) {
        row.close(linearisation.rows, residual, variance);
        if (!std::isfinite(residual)) linearisation.finite = false;
        if (variance > 0) return;
        linearisation.hard_sum += std::abs(residual);
        linearisation.hard_worst = std::max(linearisation.hard_worst, std::abs(residual));
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
    for (const ActiveCorner& h : held) {
        // Nothing pulls up what lies well below.
        if (!binds(shape, h)) continue;
        incident(h.facet, h.point, k_hold_below, k_hold_sigma * k_hold_sigma);
        linearisation.holding.push_back(h);
    }
    return linearisation;
}

}  // namespace culet
