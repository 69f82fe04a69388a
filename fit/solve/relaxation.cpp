#include "fit/solve/relaxation.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numeric>

namespace culet {

namespace {

// Corners that want to stand above a neighbour facet are held this far below it, in half diameters:
// far above rounding, far below anything one could measure.
constexpr double k_hold_below = 1e-7;
// About so far: an edge that would turn over asks its two ends to be held, which one length of the
// edge can do but about.
constexpr double k_hold_sigma = 1e-8;
// Held corners this near to their level lie at it.
constexpr double k_at_level = 0.1 * k_hold_below;
// Corners that share a caliper's jaw are level to this part of the half diameter.
constexpr double k_tie_sigma = 1e-6;
// Level at the end of an earlier fit, in half diameters: as exactly as a turn can be found.
constexpr double k_level = 1e-7;
// Of the force of a reading that is off by its sigma: with less a tie holds nothing, be it level
// by symmetry or on a level facet.
constexpr double k_no_force = 1e-3;

// Lengths are rounded off over this many times the stage's penalty scale, or the kink still shows.
constexpr double k_round = 3;

// Formula less value as a stage has it. Lengths have a kink at zero: sqrt(l^2 + s^2) on both sides,
// so that what is shorter than s is all the same to the stage, and has no direction to be held to.
Quantity misfit_of(const Equation& e, const Shape& shape, const PenaltyScale& penalty) {
    Quantity q = e.formula(shape);
    if (e.has_kink && penalty.incidence > 0) {
        const double s = k_round * penalty.incidence, round = std::hypot(q.value, s);
        for (Quantity::Slope& slope : q.slopes) slope.slope *= q.value / round;
        q.value = round - std::hypot(e.value, s);
    } else {
        q.value -= e.value;
    }
    return q;
}

// 0: it holds exactly.
double variance_of(const Equation& e, const PenaltyScale& penalty) {
    return e.exact ? penalty.incidence * penalty.incidence
                   : e.sigma * e.sigma + penalty.readings * penalty.readings;
}

double off_level(const Shape& shape, const SharedContact& tie) {
    return glm::dot(tie.direction, shape.points[tie.one] - shape.points[tie.other]);
}

// One pair of facet and point of each orbit, and how many go with it.
class OrbitPairs {
public:
    OrbitPairs(const Parameters& parameters, std::size_t facets, std::size_t points)
        : generators_(parameters.orbits().generators), points_(points) {
        if (!generators_.empty()) seen_.assign(facets * points, 0);
    }

    /// 0: seen before; else the size of the pair's orbit.
    int take(int facet, int point) {
        if (generators_.empty()) return 1;
        if (was_seen(facet, point)) return 0;
        std::vector<std::pair<int, int>> queue{{facet, point}};
        for (std::size_t q = 0; q < queue.size(); ++q) {
            for (const SymmetryMotion& g : generators_) {
                const std::pair<int, int> to{g.exchange.facets[queue[q].first],
                                             g.exchange.vertices[queue[q].second]};
                if (!was_seen(to.first, to.second)) queue.push_back(to);
            }
        }
        return static_cast<int>(queue.size());
    }

private:
    bool was_seen(int facet, int point) {
        return std::exchange(seen_[std::size_t(facet) * points_ + std::size_t(point)], 1);
    }

    const std::vector<SymmetryMotion>& generators_;
    std::size_t points_;
    std::vector<char> seen_;
};

}  // namespace

Relaxation::Relaxation(const System& system, const Parameters& parameters)
    : system_(system), parameters_(parameters) {
    const std::vector<Facet>& facets = system.stone().solid.facets;
    const std::size_t points = system.mesh_shape().points.size();
    OrbitPairs incident(parameters, facets.size(), points),
        hinged(parameters, facets.size(), points);
    for (std::size_t i = 0; i < system.incidences().size(); ++i) {
        const Incidence& incidence = system.incidences()[i];
        if (const int images = incident.take(incidence.facet, incidence.point)) {
            incidences_.push_back(static_cast<int>(i));
            incidence_images_.push_back(images);
        }
    }
    points_.resize(points);
    std::iota(points_.begin(), points_.end(), 0);
    choose(system.mesh_shape(), false);
    if (!system.stone().convex) return;
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
}

void Relaxation::choose(const Shape& shape, bool meets_hold) {
    std::vector<Equation> before = std::move(equations_);
    equations_ = system_.reading_equations(shape, system_.mesh_outline(), true, meets_hold);
    if (std::exchange(begins_, false) || before.size() != equations_.size()) return;
    for (std::size_t i = 0; i < before.size(); ++i) {
        const Equation &was = before[i], &is = equations_[i];
        if (is.caliper == Vec3(0)) continue;
        for (int jaw = 0; jaw < 2; ++jaw) {
            const int from = was.touched[std::size_t(jaw)].point,
                      to = is.touched[std::size_t(jaw)].point;
            if (from < 0 || to < 0 || from == to) continue;
            std::vector<int>& left = left_[{static_cast<int>(i), jaw}];
            if (std::find(left.begin(), left.end(), to) != left.end()) {
                shared_contacts_.push_back({from, to, is.caliper, static_cast<int>(i), jaw});
                left.clear();
            } else {
                left.push_back(from);
            }
        }
    }
}

const std::vector<int>& Relaxation::corners_between_jaws(const Equation& caliper) const {
    const Reading& reading = system_.readings()[std::size_t(caliper.reading)];
    return reading.kind == ReadingKind::table_width
               ? system_.mesh_outline()->loops[std::size_t(system_.up_facet())]
               : points_;
}

void Relaxation::share_level_corners(const Shape& shape) {
    for (std::size_t i = 0; i < equations_.size(); ++i) {
        const Equation& e = equations_[i];
        if (e.caliper == Vec3(0) || e.exact) continue;
        for (int jaw = 0; jaw < 2; ++jaw) {
            const int touched = e.touched[std::size_t(jaw)].point;
            for (const int c : corners_between_jaws(e)) {
                const double below =
                    glm::dot(e.caliper, shape.points[std::size_t(touched)] - shape.points[c]);
                if (c == touched || !(std::abs(below) < k_level)) continue;
                shared_contacts_.push_back({touched, c, e.caliper, static_cast<int>(i), jaw});
            }
        }
    }
}

bool Relaxation::contacts_hold(const Shape& shape) const {
    std::map<std::pair<int, int>, double> shared;
    for (const SharedContact& tie : shared_contacts_) {
        const Equation& e = equations_[std::size_t(tie.equation)];
        const double pull = (e.formula(shape).value - e.value) / (e.sigma * e.sigma);
        const double force = off_level(shape, tie) / (k_tie_sigma * k_tie_sigma);
        if (std::abs(force) * e.sigma < k_no_force) continue;
        const int touched = e.touched[std::size_t(tie.jaw)].point;
        const double share = (tie.jaw == 0) == (touched == tie.one) ? -force / pull : force / pull;
        double& all = shared[{tie.equation, tie.jaw}];
        all += share;
        if (!(pull > 0) || !(share > 0) || !(all < 1)) return false;
    }
    return true;
}

int Relaxation::hinge_of(const ActiveCorner& held) const {
    const auto at =
        std::lower_bound(hinges_.begin(), hinges_.end(), std::make_pair(held.facet, held.point));
    return static_cast<int>(at - hinges_.begin());
}

double Relaxation::height(const Shape& shape, int facet, int point) const {
    return glm::dot(shape.normals[facet], shape.points[point]) - shape.offsets[facet];
}

double Relaxation::incidence_variance(std::size_t incidence, const PenaltyScale& penalty) const {
    const double own =
        system_.incidence_sigma(system_.incidences()[std::size_t(incidences_[incidence])]);
    return (own * own + penalty.incidence * penalty.incidence) / incidence_images_[incidence];
}

Relaxation::Counts Relaxation::counts() const {
    Counts counts;
    for (int i : incidences_) {
        const MeetTreatment how = system_.incidences()[i].how;
        counts.hard += how == MeetTreatment::exact;
        counts.soft += how == MeetTreatment::soft;
    }
    for (const Equation& e : equations_) (e.exact ? counts.hard : counts.soft) += e.readings();
    return counts;
}

double Relaxation::expected_misfit(const PenaltyScale& penalty) const {
    double sum = 0;
    const auto add = [&](double sigma, double soft) {
        if (sigma > 0) sum += sigma * sigma / (sigma * sigma + soft * soft);
    };
    for (int i : incidences_) {
        add(system_.incidence_sigma(system_.incidences()[i]), penalty.incidence);
    }
    for (const Equation& e : equations_) add(e.exact ? 0 : e.sigma, penalty.readings);
    return sum;
}

Eigen::VectorXd Relaxation::metric() const {
    const std::vector<double>& m = parameters_.metric();
    return Eigen::Map<const Eigen::VectorXd>(m.data(), Eigen::Index(m.size()));
}

bool Relaxation::binds(const Shape& shape, const ActiveCorner& held) const {
    return height(shape, held.facet, held.point) > -1.5 * k_hold_below;
}

bool Relaxation::are_ends_of_one_edge(const ActiveCorner& one, const ActiveCorner& other) const {
    const auto is_corner = [&](int facet, int point) {
        const std::vector<int>& loop = system_.stone().solid.facets[std::size_t(facet)].corners;
        return std::find(loop.begin(), loop.end(), point) != loop.end();
    };
    return is_corner(one.facet, other.point) && is_corner(other.facet, one.point);
}

int Relaxation::binding(const Shape& shape, const std::vector<ActiveCorner>& held) const {
    std::vector<ActiveCorner> found;
    for (const ActiveCorner& h : held) {
        const bool is_known =
            std::any_of(found.begin(), found.end(),
                        [&](const ActiveCorner& other) { return are_ends_of_one_edge(other, h); });
        if (!is_known && binds(shape, h)) found.push_back(h);
    }
    return static_cast<int>(found.size());
}

std::vector<ActiveCorner> Relaxation::above(const Shape& shape, double margin) const {
    std::vector<ActiveCorner> result;
    for (const auto& [f, p] : hinges_) {
        if (height(shape, f, p) + margin > 0) result.push_back({f, p});
    }
    return result;
}

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

std::vector<Relaxation::Folded> Relaxation::folded(const Shape& shape, double within) const {
    std::vector<Folded> result;
    std::map<std::pair<int, bool>, std::size_t> known;
    int row = static_cast<int>(incidences_.size());
    for (const Equation& e : equations_) {
        if (e.other_value && !e.exact) {
            const int f = system_.readings()[std::size_t(e.reading)].facets[0];
            if (std::abs(shape.normals[f].z) < within) {
                const double shift = *e.other_value - e.value;
                const auto [at, is_new] = known.try_emplace({f, shift > 0}, result.size());
                if (is_new) result.push_back({f, {}});
                result[at->second].turns.push_back({row, shift});
            }
        }
        ++row;
    }
    return result;
}

std::vector<Relaxation::Caliper> Relaxation::calipers_that_tell_the_turn() const {
    std::vector<Caliper> result;
    // Mirrors and rotations of the stone have a place of their own, which would turn with it.
    // The facets' prior tells the turn by itself.
    if (!parameters_.orbits().empty() || !system_.mesh_shape().extras.empty() ||
        system_.has_prior()) {
        return result;
    }
    int row = static_cast<int>(incidences_.size());
    for (const Equation& e : equations_) {
        const Reading& reading = system_.readings()[std::size_t(e.reading)];
        const bool is_level = std::hypot(e.caliper.x, e.caliper.y) > 0;
        if (reading.kind == ReadingKind::azimuth && reading.datum.kind == Datum::Kind::up) {
            return {};
        }
        if (is_level) {
            if (e.caliper.z != 0 || e.exact) return {};
            result.push_back({row, e.caliper, e.value, e.sigma, &corners_between_jaws(e)});
        }
        ++row;
    }
    return result;
}

}  // namespace culet
