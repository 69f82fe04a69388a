#include "fit/solve/relaxation.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numeric>

#include "fit/model/constants.h"
#include "fit/model/enclosed.h"
#include "fit/model/equations.h"
#include "fit/model/linear.h"
#include "fit/solve/constants.h"
#include "fit/solve/relaxation_terms.h"

namespace culet {

namespace {

class OrbitPairs {
public:
    OrbitPairs(const Parameters& parameters, std::size_t facets, std::size_t points)
        : generators_(parameters.orbits().generators), points_(points) {
        if (!generators_.empty()) seen_.assign(facets * points, 0);
    }

    /// Returns the size of the pair's orbit, or 0 if it was seen before.
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

Relaxation::Relaxation(const FitModel& model, const Parameters& parameters)
    : model_(model), parameters_(parameters) {
    const std::size_t facets = model.stone().solid.facets.size(),
                      points = model.mesh_shape().points.size();
    OrbitPairs incident(parameters, facets, points), hinged(parameters, facets, points);
    for (std::size_t i = 0; i < model.meets().incidences.size(); ++i) {
        const Incidence& at = model.meets().incidences[i];
        if (const int images = incident.take(at.facet, at.point))
            incidences_.push_back({at.facet, at.point, double(images), int(i)});
    }
    points_.resize(points);
    std::iota(points_.begin(), points_.end(), 0);
    select_branches(model.mesh_shape(), false);
    for (const auto& [f, p] : hinges_of(model)) {
        if (const int images = hinged.take(f, p)) hinges_.push_back({f, p, double(images), -1});
    }
}

void Relaxation::select_branches(const Shape& shape, bool meets_hold,
                                 std::shared_ptr<const Outline> outline) {
    std::vector<Equation> before = std::move(equations_);
    equations_ = reading_equations(model_, shape, outline ? outline : model_.mesh_outline(), true,
                                   meets_hold);
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
    const Reading& reading = model_.readings()[std::size_t(caliper.reading)];
    return reading.kind == ReadingKind::table_width
               ? model_.mesh_outline()->loops[std::size_t(model_.frame().up_facet())]
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
                if (c == touched || !(std::abs(below) < k_jaws.was_level)) continue;
                shared_contacts_.push_back({touched, c, e.caliper, static_cast<int>(i), jaw});
            }
        }
    }
}

bool Relaxation::contacts_hold(const Shape& shape) const {
    std::map<std::pair<int, int>, double> shared;
    for (const SharedContact& contact : shared_contacts_) {
        const Equation& e = equations_[std::size_t(contact.equation)];
        const double pull = (e.formula(shape).value - e.value) / (e.sigma * e.sigma);
        const double multiplier =
            off_level(shape, contact) / (k_jaws.contact_sigma * k_jaws.contact_sigma);
        if (std::abs(multiplier) * e.sigma < k_jaws.least_multiplier) continue;
        const int touched = e.touched[std::size_t(contact.jaw)].point;
        const double share =
            (contact.jaw == 0) == (touched == contact.one) ? -multiplier / pull : multiplier / pull;
        double& all = shared[{contact.equation, contact.jaw}];
        all += share;
        if (!(pull > 0) || !(share > 0) || !(all < 1)) return false;
    }
    return true;
}

const Relaxation::OrbitPair* Relaxation::hinge_of(const ActiveCorner& corner) const {
    return &*std::lower_bound(hinges_.begin(), hinges_.end(), corner,
                              [](const OrbitPair& h, const ActiveCorner& c) {
                                  return std::pair(h.facet, h.point) < std::pair(c.facet, c.point);
                              });
}

double Relaxation::height(const Shape& shape, int facet, int point) const {
    return glm::dot(shape.normals[facet], shape.points[point]) - shape.offsets[facet];
}

Relaxation::Counts Relaxation::counts() const {
    Counts counts;
    for (const OrbitPair& i : incidences_) {
        const MeetTreatment how = model_.meets().incidences[std::size_t(i.incidence)].how;
        counts.hard += how == MeetTreatment::exact;
        counts.soft += how == MeetTreatment::soft;
    }
    for (const Equation& e : equations_) (e.exact ? counts.hard : counts.soft) += e.readings();
    const int shifts = parameters_.orbits().empty() ? 3 : 1;
    counts.free = std::max(0, parameters_.size() - counts.hard - shifts);
    return counts;
}

double Relaxation::expected_misfit(const PenaltyScale& penalty) const {
    double sum = 0;
    const auto add = [&](double sigma, double soft) {
        if (sigma > 0) sum += sigma * sigma / (sigma * sigma + soft * soft);
    };
    for (const OrbitPair& i : incidences_) {
        add(model_.meets().sigma(model_.meets().incidences[std::size_t(i.incidence)]),
            penalty.incidence);
    }
    for (const Equation& e : equations_) add(e.exact ? 0 : e.sigma, penalty.readings);
    return sum;
}

Eigen::VectorXd Relaxation::metric() const {
    const std::vector<double>& m = parameters_.metric();
    Eigen::VectorXd metric = Eigen::Map<const Eigen::VectorXd>(m.data(), Eigen::Index(m.size()));
    if (!model_.meets().splits) return metric;
    const Parameters::TangentBasis basis = parameters_.tangent_basis(model_.mesh_shape());
    const std::vector<bool> loose = loose_points(model_);
    for (std::size_t p = 0; p < loose.size(); ++p) {
        if (loose[p])
            metric.segment(basis.points[p].column, basis.points[p].count) *= k_shapes.loose_point;
    }
    return metric;
}

bool Relaxation::binds(const Shape& shape, const ActiveCorner& held) const {
    return height(shape, held.facet, held.point) > -1.5 * k_held.below;
}

bool are_ends_of_one_edge(const FitModel& model, const ActiveCorner& one,
                          const ActiveCorner& other) {
    const auto is_corner = [&](int facet, int point) {
        const std::vector<int>& loop = model.stone().solid.facets[std::size_t(facet)].corners;
        return std::find(loop.begin(), loop.end(), point) != loop.end();
    };
    return is_corner(one.facet, other.point) && is_corner(other.facet, one.point);
}

int Relaxation::binding(const Shape& shape, const std::vector<ActiveCorner>& held) const {
    std::vector<ActiveCorner> found;
    for (const ActiveCorner& h : held) {
        const bool is_known = std::any_of(
            found.begin(), found.end(),
            [&](const ActiveCorner& other) { return are_ends_of_one_edge(model_, other, h); });
        if (!is_known && binds(shape, h)) found.push_back(h);
    }
    return static_cast<int>(found.size());
}

std::vector<ActiveCorner> Relaxation::above(const Shape& shape, double margin) const {
    std::vector<ActiveCorner> result;
    for (const OrbitPair& h : hinges_) {
        if (height(shape, h.facet, h.point) + margin > 0) result.push_back({h.facet, h.point});
    }
    return result;
}

std::vector<Relaxation::SignAmbiguity> Relaxation::ambiguous(const Shape& shape,
                                                             double within) const {
    std::vector<SignAmbiguity> result;
    std::map<std::pair<int, bool>, std::size_t> known;
    int row = static_cast<int>(incidences_.size());
    for (const Equation& e : equations_) {
        if (e.other_value && !e.exact) {
            const int f = model_.readings()[std::size_t(e.reading)].facets[0];
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
    // Mirrors and rotations have axes of their own, which would turn too. A prior of the facets
    // determines the azimuth by itself.
    if (!parameters_.orbits().empty() || !model_.mesh_shape().extras.empty() ||
        !model_.prior().empty() || !model_.known_planes().empty()) {
        return result;
    }
    for (const Equation& e : equations_) {
        const Reading& reading = model_.readings()[std::size_t(e.reading)];
        const bool is_level = std::hypot(e.caliper.x, e.caliper.y) > 0;
        if (reading.kind == ReadingKind::azimuth && reading.datum.kind == Datum::Kind::up) {
            return {};
        }
        if (is_level) {
            if (e.caliper.z != 0 || e.exact) return {};
            result.push_back({e.caliper, e.value, e.sigma, &corners_between_jaws(e)});
        }
    }
    return result;
}

}  // namespace culet
