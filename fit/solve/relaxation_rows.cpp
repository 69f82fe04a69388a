// The equations of a relaxation at a shape: as rows in the parameters, and as residuals for Ceres.

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "fit/solve/relaxation.h"
#include "fit/solve/relaxation_terms.h"

namespace culet {

namespace {

// How far a plane passes a point.
void write_incidence(const Shape& shape, int facet, int point, Parameters::Row& row) {
    row.normal(facet, shape.points[point]);
    row.offset(facet, -1);
    row.point(point, shape.normals[facet]);
}

}  // namespace

// The equations of a stage at one shape, kind by kind, in the order of their rows.
class Relaxation::Assembly {
public:
    Assembly(const Relaxation& of, const Shape& shape, const PenaltyScale& penalty)
        : of_(of),
          shape_(shape),
          penalty_(penalty),
          tangent_basis_(of.parameters_.tangent_basis(shape)),
          row_(tangent_basis_, of.parameters_.size()) {
        sum_.rows.reserve(of.most_rows_, of.most_entries_);
        sum_.prior_stiffness = Eigen::VectorXd::Zero(of.parameters_.size());
        sum_.prior_gradient = Eigen::VectorXd::Zero(of.parameters_.size());
    }

    void add_incidences();
    void add_readings();
    void add_held_corners(const std::vector<ActiveCorner>& held);
    void add_shared_contacts();
    void add_hinges();
    void add_priors();
    StepLinearisation take();

private:
    void count_hard(double residual) {
        sum_.hard_sum += std::abs(residual);
        sum_.hard_worst = std::max(sum_.hard_worst, std::abs(residual));
    }
    void close(double residual, double variance);

    const Relaxation& of_;
    const Shape& shape_;
    const PenaltyScale& penalty_;
    Parameters::TangentBasis tangent_basis_;
    Parameters::Row row_;
    std::vector<int> held_hinges_;
    StepLinearisation sum_;
};

void Relaxation::Assembly::close(double residual, double variance) {
    row_.close(sum_.rows, residual, variance);
    if (!std::isfinite(residual)) sum_.finite = false;
    if (variance > 0) {
        sum_.merit += residual * residual / variance;
    } else {
        count_hard(residual);
    }
}

void Relaxation::Assembly::add_incidences() {
    for (std::size_t i = 0; i < of_.incidences_.size(); ++i) {
        const Incidence& incidence = of_.system_.incidences()[of_.incidences_[i]];
        const double residual = of_.height(shape_, incidence.facet, incidence.point);
        write_incidence(shape_, incidence.facet, incidence.point, row_);
        if (incidence.how == MeetTreatment::soft) {
            const double own = of_.system_.incidence_sigma(incidence);
            sum_.chi2 += of_.incidence_images_[i] * residual * residual / (own * own);
        }
        close(residual, of_.incidence_variance(i, penalty_));
    }
}

void Relaxation::Assembly::add_readings() {
    if (!penalty_.with_readings) return;
    for (const Equation& e : of_.equations_) {
        const Quantity q = misfit_of(e, shape_, penalty_);
        row_.quantity(q);
        if (!e.exact) sum_.chi2 += q.value * q.value / (e.sigma * e.sigma) + e.scatter;
        close(q.value, variance_of(e, penalty_));
    }
}

// Hard but for what an edge's other end asks: squares of such weight would forbid every step that
// bends.
void Relaxation::Assembly::add_held_corners(const std::vector<ActiveCorner>& held) {
    for (const ActiveCorner& h : held) {
        held_hinges_.push_back(of_.hinge_of(h));
        const double residual = of_.height(shape_, h.facet, h.point) + k_hold_below;
        if (!std::isfinite(residual)) sum_.finite = false;
        count_hard(std::max(0.0, residual));
        // Nothing pulls up what lies below.
        if (!(residual > -k_at_level)) continue;
        write_incidence(shape_, h.facet, h.point, row_);
        row_.close(sum_.rows, residual, k_hold_sigma * k_hold_sigma);
        sum_.holding.push_back(h);
    }
    std::sort(held_hinges_.begin(), held_hinges_.end());
}

void Relaxation::Assembly::add_shared_contacts() {
    const double soft2 = penalty_.incidence * penalty_.incidence;
    for (const SharedContact& contact : of_.shared_contacts_) {
        row_.point(contact.one, contact.direction);
        row_.point(contact.other, -contact.direction);
        close(off_level(shape_, contact), k_contact_sigma * k_contact_sigma + soft2);
    }
}

// But those of held corners.
void Relaxation::Assembly::add_hinges() {
    if (!penalty_.with_hinges) return;
    for (int i = 0; i < static_cast<int>(of_.hinges_.size()); ++i) {
        const auto& [f, p] = of_.hinges_[std::size_t(i)];
        const double residual = of_.height(shape_, f, p);
        const double variance = penalty_.hinge * penalty_.hinge / of_.hinge_images_[std::size_t(i)];
        if (!std::isfinite(residual)) sum_.finite = false;
        if (std::binary_search(held_hinges_.begin(), held_hinges_.end(), i)) continue;
        if (!(residual > 0)) continue;
        sum_.merit += residual * residual / variance;
        write_incidence(shape_, f, p, row_);
        row_.close(sum_.rows, residual, variance);
    }
}

void Relaxation::Assembly::add_priors() {
    if (!penalty_.with_priors) return;
    const Shape& mesh = of_.system_.mesh_shape();
    const double stiffness = 1 / (penalty_.mesh_sigma * penalty_.mesh_sigma);
    for (int p = 0; p < static_cast<int>(shape_.points.size()); ++p) {
        const Parameters::Slots& slots = tangent_basis_.points[p];
        const Vec3 off = (shape_.points[p] - mesh.points[p]) * stiffness;
        sum_.prior += glm::dot(off, shape_.points[p] - mesh.points[p]);
        for (int k = 0; k < slots.count; ++k) {
            sum_.prior_stiffness(slots.column + k) += stiffness;
            sum_.prior_gradient(slots.column + k) += glm::dot(slots.along[std::size_t(k)], off);
        }
    }
}

StepLinearisation Relaxation::Assembly::take() {
    sum_.merit += sum_.prior;
    if (!std::isfinite(sum_.merit)) sum_.finite = false;
    return std::move(sum_);
}

StepLinearisation Relaxation::linearisation(const Shape& shape, const PenaltyScale& penalty,
                                            const std::vector<ActiveCorner>& held) {
    Assembly assembly(*this, shape, penalty);
    assembly.add_incidences();
    assembly.add_readings();
    assembly.add_held_corners(held);
    assembly.add_shared_contacts();
    assembly.add_hinges();
    assembly.add_priors();
    StepLinearisation linearisation = assembly.take();
    most_rows_ = std::max(most_rows_, linearisation.rows.residual.size());
    most_entries_ = std::max(most_entries_, linearisation.rows.column.size());
    return linearisation;
}

std::vector<Relaxation::Residual> Relaxation::residuals(const PenaltyScale& penalty) const {
    std::vector<Residual> all;
    for (std::size_t i = 0; i < incidences_.size(); ++i) {
        const Incidence& incidence = system_.incidences()[std::size_t(incidences_[i])];
        all.push_back({culet::height(incidence.facet, Corner{incidence.point}),
                       std::sqrt(incidence_variance(i, penalty))});
    }
    for (const Equation& e : equations_) {
        if (!penalty.with_readings) break;
        all.push_back({[&e, &penalty](const Shape& shape) { return misfit_of(e, shape, penalty); },
                       std::sqrt(variance_of(e, penalty))});
    }
    for (const SharedContact& contact : shared_contacts_) {
        all.push_back({extent(Corner{contact.one}, Corner{contact.other}, contact.direction),
                       std::hypot(k_contact_sigma, penalty.incidence)});
    }
    for (const int p : points_) {
        if (!penalty.with_priors) break;
        const Vec3& drawn = system_.mesh_shape().points[std::size_t(p)];
        for (int k = 0; k < 3; ++k) {
            Vec3 axis(0);
            axis[k] = 1;
            all.push_back({point_component(p, axis, drawn[k]), penalty.mesh_sigma});
        }
    }
    return all;
}

Relaxation::Residual Relaxation::hinge(const ActiveCorner& corner,
                                       const PenaltyScale& penalty) const {
    const double images = hinge_images_[std::size_t(hinge_of(corner))];
    return {culet::height(corner.facet, Corner{corner.point}), penalty.hinge / std::sqrt(images)};
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
    for (const SharedContact& contact : shared_contacts_) {
        put(off_level(shape, contact), false);
        ++row;
    }
    return missed;
}

double Relaxation::worst_hard(const Shape& shape) const {
    return missed(shape, {}, {}, std::numeric_limits<double>::min()).worst;
}

}  // namespace culet
