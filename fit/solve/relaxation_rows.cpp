// Lists the terms of a relaxation, and linearises them for Newton steps.

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "fit/model/equations.h"
#include "fit/solve/constants.h"
#include "fit/solve/relaxation.h"
#include "fit/solve/relaxation_terms.h"

namespace culet {

std::vector<Relaxation::Term> Relaxation::terms(const PenaltyScale& penalty,
                                                const std::vector<ActiveCorner>& held,
                                                const std::vector<ActiveCorner>& hinges) const {
    std::vector<Term> all;
    all.reserve(incidences_.size() + equations_.size() + held.size() + hinges.size());
    for (const OrbitPair& i : incidences_) {
        const Incidence& incidence = model_.meets().incidences[std::size_t(i.incidence)];
        const double own = model_.meets().sigma(incidence);
        const double variance = (own * own + penalty.incidence * penalty.incidence) / i.images;
        Term& term = all.emplace_back(Term{culet::height(i.facet, Corner{i.point}), variance});
        if (incidence.how == MeetTreatment::soft) term.chi2_weight = i.images / (own * own);
    }
    for (const Equation& e : equations_) {
        if (!penalty.with_readings) break;
        Term& term = all.emplace_back(
            Term{[&e, &penalty](const Shape& shape) { return misfit_of(e, shape, penalty); },
                 variance_of(e, penalty)});
        if (!e.is_counted()) continue;
        term.chi2_weight = 1 / (e.sigma * e.sigma);
        term.scatter = e.scatter;
    }
    // Held corners are hard but for what an edge's other end asks. They stay out of the merit: with
    // their weight every curved step would be rejected.
    for (const ActiveCorner& h : held) {
        all.push_back({[h](const Shape& shape) {
                           Quantity q = culet::height(h.facet, Corner{h.point})(shape);
                           q.value += k_held.below;
                           return q;
                       },
                       penalty.held * penalty.held, Term::Kind::held_corner});
        all.back().corner = h;
    }
    for (const SharedContact& contact : shared_contacts_) {
        all.push_back(
            {extent(Corner{contact.one}, Corner{contact.other}, contact.direction),
             k_jaws.contact_sigma * k_jaws.contact_sigma + penalty.incidence * penalty.incidence,
             Term::Kind::contact});
    }
    for (const ActiveCorner& h : hinges) {
        if (std::find(held.begin(), held.end(), h) != held.end()) continue;
        all.push_back({culet::height(h.facet, Corner{h.point}),
                       penalty.hinge * penalty.hinge / hinge_of(h)->images, Term::Kind::hinge});
    }
    return all;
}

StepLinearisation Relaxation::linearisation(const Shape& shape, const PenaltyScale& penalty,
                                            const std::vector<ActiveCorner>& held) const {
    StepLinearisation sum;
    const Parameters::TangentBasis basis = parameters_.tangent_basis(shape);
    Parameters::Row row(basis, parameters_.size());
    const std::vector<ActiveCorner> hinges =
        penalty.with_hinges ? above(shape) : std::vector<ActiveCorner>();
    for (const Term& term : terms(penalty, held, hinges)) {
        const Quantity q = term.formula(shape);
        if (!std::isfinite(q.value)) sum.finite = false;
        const bool is_held = term.kind == Term::Kind::held_corner;
        if (is_held || term.variance == 0) {
            sum.hard_sum += is_held ? std::max(0.0, q.value) : std::abs(q.value);
        }
        // No row for a corner below its level: nothing pulls it up.
        if (is_held && !(q.value > -k_held.at_level)) continue;
        if (is_held) {
            sum.holding.push_back(term.corner);
        } else if (term.variance > 0) {
            sum.merit += q.value * q.value / term.variance;
        }
        sum.chi2 += term.chi2_weight * q.value * q.value + term.scatter;
        row.quantity(q);
        row.close(sum.rows, q.value, term.variance);
    }
    add_priors(shape, penalty, basis, sum);
    sum.merit += sum.prior;
    if (!std::isfinite(sum.merit)) sum.finite = false;
    return sum;
}

void Relaxation::add_priors(const Shape& shape, const PenaltyScale& penalty,
                            const Parameters::TangentBasis& basis, StepLinearisation& sum) const {
    sum.prior_stiffness = Eigen::VectorXd::Zero(parameters_.size());
    if (!penalty.with_priors) return;
    const Shape& mesh = model_.mesh_shape();
    const double stiffness = 1 / (penalty.mesh_sigma * penalty.mesh_sigma);
    for (std::size_t p = 0; p < shape.points.size(); ++p) {
        const Parameters::Slots& slots = basis.points[p];
        const Vec3 off = shape.points[p] - mesh.points[p];
        sum.prior += stiffness * glm::dot(off, off);
        for (int k = 0; k < slots.count; ++k) sum.prior_stiffness(slots.column + k) += stiffness;
    }
}

Relaxation::Missed Relaxation::missed(const Shape& shape, const PenaltyScale& penalty,
                                      const std::vector<ActiveCorner>& holding,
                                      double sharp) const {
    const std::vector<Term> all = terms(penalty, holding);
    Missed missed;
    missed.residuals = Eigen::VectorXd::Zero(Eigen::Index(all.size()));
    for (std::size_t i = 0; i < all.size(); ++i) {
        const bool is_held = all[i].kind == Term::Kind::held_corner;
        if (!(all[i].variance < sharp) && !is_held && all[i].kind != Term::Kind::contact) continue;
        const double residual = all[i].formula(shape).value;
        missed.residuals(Eigen::Index(i)) = residual;
        const bool is_hard = all[i].variance == 0 || is_held;
        if (is_hard && !(std::abs(residual) <= missed.worst)) missed.worst = std::abs(residual);
    }
    return missed;
}

double Relaxation::worst_hard(const Shape& shape) const {
    return missed(shape, {}, {}, std::numeric_limits<double>::min()).worst;
}

}  // namespace culet
