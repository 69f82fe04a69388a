#include "fit/extra_facets.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <map>

#include "fit/covariance.h"
#include "fit/cut_off.h"
#include "fit/statistics.h"

namespace culet {

namespace {

using Index = Eigen::Index;

// Directions whose sum is shorter face away from each other: no direction lies between them.
constexpr double k_opposite = 1e-6;
// Rounds of looking for one more explanation.
constexpr int k_most_rounds = 16;
constexpr double k_checked = 1e-4;
constexpr double k_no_redundancy = 1e-10;
// Planes that change more equations than this are tried without asking first what they may bring.
constexpr std::size_t k_most_asked = 48;
// Of so many equations the hat matrix has room: 8 MB.
constexpr Index k_most_kept = 1000;
// Twice the log of the likelihood ratio below which two explanations are as good as each other.
constexpr double k_alternative = 3;
// Shown by a single reading, only what one may well overlook: of the half diameter.
constexpr double k_overlooked = 0.1;
// Depths tried: each this part of the one before.
constexpr double k_next_depth = 0.7;
constexpr int k_depths = 24;
// A direction is left after two depths from which the best multiple would bring so little.
constexpr double k_far_from = 0.25;

// How readings change when a part of the stone is cut off.
class Signatures {
public:
    Signatures(const System& system, const Shape& shape, const Outline& outline,
               const Linearised& linear)
        : system_(system), net_(shape, outline), linear_(linear), by_corner_(net_.places().size()) {
        for (std::size_t i = 0; i < linear.soft.size(); ++i) list(Index(i), outline);
    }

    const CornerNet& net() const { return net_; }

    // The equations that change, in their order. Of a part of what is cut off, no others do.
    std::vector<Index> touched_by(const CutOff& off) const {
        std::vector<Index> touched = volumes_;
        for (const int corner : off.gone) {
            const std::vector<Index>& here = by_corner_[std::size_t(corner)];
            touched.insert(touched.end(), here.begin(), here.end());
        }
        std::sort(touched.begin(), touched.end());
        touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
        return touched;
    }

    // In sigmas, of the equations that change.
    std::vector<std::pair<Index, double>> of(const Plane& plane, const CutOff& off,
                                             const std::vector<Index>& touched) const {
        std::vector<std::pair<Index, double>> signature;
        for (const Index i : touched) {
            const double change = change_of(i, plane, off);
            if (change != 0) {
                signature.emplace_back(i, change / linear_.soft[std::size_t(i)].sigma);
            }
        }
        return signature;
    }

private:
    const Reading& reading_of(Index i) const {
        return system_.readings()[std::size_t(linear_.soft[std::size_t(i)].reading)];
    }

    // Which corners a reading depends on.
    void list(Index i, const Outline& outline) {
        const Equation& e = linear_.soft[std::size_t(i)];
        if (e.role != Equation::Role::reading || e.reading < 0) return;
        const Reading& reading = reading_of(i);
        switch (reading.kind) {
            case ReadingKind::edge:
                if (reading.aggregate == Aggregate::min || reading.aggregate == Aggregate::max) {
                    return;
                }
                for (std::size_t k = 0; k + 1 < reading.facets.size(); k += 2) {
                    if (const auto ends = net_.edge(reading.facets[k], reading.facets[k + 1])) {
                        by_corner_[std::size_t(ends->first)].push_back(i);
                        by_corner_[std::size_t(ends->second)].push_back(i);
                    }
                }
                return;
            case ReadingKind::width:
            case ReadingKind::depth:
            case ReadingKind::table_width:
                for (const Corner& touched : e.touched) {
                    const Vec3 side = &touched == e.touched.data() ? e.caliper : -e.caliper;
                    const int facet =
                        reading.kind == ReadingKind::table_width ? system_.up_facet() : -1;
                    const double most = net_.reach(side, {}, facet);
                    for (std::size_t c = 0; c < net_.places().size(); ++c) {
                        // Corners as far out stand for each other.
                        if (glm::dot(side, net_.places()[c]) > most - 1e-9) {
                            by_corner_[c].push_back(i);
                        }
                    }
                }
                return;
            case ReadingKind::distance:
                for (const Place& place : reading.places) {
                    if (place.kind != Place::Kind::vertex) continue;
                    for (std::size_t c = 0; c < outline.corners.size(); ++c) {
                        if (outline.corners[c].point == place.vertex) {
                            by_corner_[c].push_back(i);
                        }
                    }
                }
                return;
            case ReadingKind::volume:
            case ReadingKind::weight:
                volumes_.push_back(i);
                return;
            default:
                return;
        }
    }

    double change_of(Index i, const Plane& plane, const CutOff& off) const {
        const Equation& e = linear_.soft[std::size_t(i)];
        const Reading& reading = reading_of(i);
        switch (reading.kind) {
            case ReadingKind::edge: {
                double change = 0;
                for (std::size_t k = 0; k + 1 < reading.facets.size(); k += 2) {
                    const auto ends = net_.edge(reading.facets[k], reading.facets[k + 1]);
                    if (!ends) continue;
                    change += net_.edge_length(ends->first, ends->second, off) -
                              net_.edge_length(ends->first, ends->second, {});
                }
                return change / (0.5 * double(reading.facets.size()));
            }
            case ReadingKind::width:
            case ReadingKind::depth:
            case ReadingKind::table_width: {
                const int facet =
                    reading.kind == ReadingKind::table_width ? system_.up_facet() : -1;
                const Vec3& d = e.caliper;
                return net_.reach(d, off, facet) + net_.reach(-d, off, facet) -
                       net_.reach(d, {}, facet) - net_.reach(-d, {}, facet);
            }
            case ReadingKind::distance: {
                // From a facet to what is now the highest place above it.
                Place a = reading.places[0], b = reading.places[1];
                if (a.kind > b.kind) std::swap(a, b);
                if (a.kind != Place::Kind::facet || b.kind != Place::Kind::vertex) return 0;
                const Vec3 away = -linear_normal(a.facet);
                double before = -1e300, after = -1e300;
                for (const int c : off.gone) {
                    before = std::max(before, glm::dot(away, net_.places()[std::size_t(c)]));
                }
                for (const CutOff::NewCorner& c : off.made) {
                    after = std::max(after, glm::dot(away, c.place));
                }
                return std::min(0.0, after - before);
            }
            default:
                return -net_.volume(plane, off);
        }
    }

    Vec3 linear_normal(int facet) const {
        const std::vector<int>& loop = net_.loop(facet);
        std::vector<Vec3> corners;
        for (const int c : loop) corners.push_back(net_.places()[std::size_t(c)]);
        return plane_through(corners).normal;
    }

    const System& system_;
    CornerNet net_;
    const Linearised& linear_;
    std::vector<std::vector<Index>> by_corner_;
    std::vector<Index> volumes_;
};

// Residuals as explanations are taken out one by one.
class Remains {
public:
    Remains(const Linearised& linear, const Covariance& covariance)
        : covariance_(covariance),
          count_(linear.soft_residuals.size()),
          counted_(Eigen::VectorXd::Zero(count_)) {
        for (Index i = 0; i < count_; ++i) {
            counted_(i) = linear.soft[std::size_t(i)].is_counted() ? 1 : 0;
        }
        values_ = linear.soft_residuals.cwiseProduct(counted_);
        values_ -= covariance.fitted_part(values_);
        redundancy_ = (counted_ - covariance.leverages()).cwiseMax(0).cwiseProduct(counted_);
        if (count_ <= k_most_kept) {
            hat_.setConstant(count_, count_, std::numeric_limits<double>::quiet_NaN());
        }
    }

    Index size() const { return count_; }
    const Eigen::VectorXd& values() const { return values_; }
    double squares() const { return std::max(1e-300, values_.squaredNorm()); }

    // What a wrong reading in this equation would explain.
    double gain_of(Index i) const {
        return redundancy_(i) > k_checked ? values_(i) * values_(i) / redundancy_(i) : 0;
    }

    // No signature of these equations alone lowers chi-square by more than r'R^-1 r, with both cut
    // down to them: the maximum of -2 r's - s'Rs. Planes of all directions and depths at a place
    // mostly change the same ones.
    double most_of(const std::vector<Index>& equations) const {
        const auto [found, is_new] = most_.try_emplace(equations, 0.0);
        if (is_new) found->second = find_most_of(equations);
        return found->second;
    }

    // R s, as far as R is left.
    Eigen::VectorXd seen(const std::vector<std::pair<Index, double>>& signature) const {
        Eigen::VectorXd s = Eigen::VectorXd::Zero(count_);
        for (const auto& [i, value] : signature) s(i) = value;
        Eigen::VectorXd result = s - covariance_.fitted_part(s);
        if (columns_.cols() == 0) return result;
        // R s less what the readings set aside would take up.
        Eigen::VectorXd at(Index(aside_.size()));
        for (std::size_t k = 0; k < aside_.size(); ++k) at(Index(k)) = result(aside_[k]);
        return result - aside_part_ * at;
    }

    void add(const Eigen::VectorXd& change) {
        values_ += change;
        most_.clear();
    }

    void set_aside(Index i) {
        const double own = redundancy_(i);
        const Eigen::VectorXd column = seen({{i, 1.0}}) / own;
        values_ -= column * values_(i);
        redundancy_ -= own * column.cwiseAbs2();
        redundancy_ = redundancy_.cwiseMax(0);
        redundancy_(i) = values_(i) = 0;
        Eigen::VectorXd whole = Eigen::VectorXd::Zero(count_);
        whole(i) = 1;
        whole -= covariance_.fitted_part(whole);
        aside_.push_back(i);
        Eigen::MatrixXd columns(count_, Index(aside_.size()));
        columns << columns_, whole;
        columns_ = std::move(columns);
        block_.resize(columns_.cols(), columns_.cols());
        for (std::size_t k = 0; k < aside_.size(); ++k) {
            block_.row(Index(k)) = columns_.row(aside_[k]);
        }
        aside_part_ = block_.ldlt().solve(columns_.transpose()).transpose();
        most_.clear();
    }

private:
    double leverage(Index i, Index j) const {
        if (hat_.size() == 0) return covariance_.leverage(i, j);
        double& known = hat_(std::min(i, j), std::max(i, j));
        if (std::isnan(known)) known = covariance_.leverage(i, j);
        return known;
    }

    double find_most_of(const std::vector<Index>& equations) const {
        const Index count = Index(equations.size());
        Eigen::MatrixXd block(count, count);
        Eigen::VectorXd values(count);
        for (Index a = 0; a < count; ++a) {
            const Index i = equations[std::size_t(a)];
            values(a) = values_(i);
            for (Index b = 0; b <= a; ++b) {
                const Index j = equations[std::size_t(b)];
                double entry = (i == j ? 1 : 0) - leverage(i, j);
                if (columns_.cols() > 0) entry -= aside_part_.row(i).dot(columns_.row(j));
                block(a, b) = entry + (i == j ? k_no_redundancy : 0);
            }
        }
        const Eigen::LDLT<Eigen::MatrixXd> factors(block);
        return factors.info() == Eigen::Success && factors.isPositive()
                   ? values.dot(factors.solve(values)) * (1 + 1e-6)
                   : 1e300;
    }

    const Covariance& covariance_;
    Index count_;
    Eigen::VectorXd counted_, values_, redundancy_;
    std::vector<Index> aside_;
    Eigen::MatrixXd columns_ = Eigen::MatrixXd(count_, 0), block_, aside_part_;
    mutable std::map<std::vector<Index>, double> most_;  // of what is left now
    mutable Eigen::MatrixXd hat_;  // what is known of it: NaN is not; empty when it would be large
};

struct Candidate {
    std::vector<int> facets;
    std::vector<Vec3> directions;
};

// The mean of the normals, and half-way from there to each.
Candidate candidate_at(const Shape& shape, std::vector<int> facets) {
    Candidate candidate;
    Vec3 sum(0);
    for (const int f : facets) sum += shape.normals[std::size_t(f)];
    if (!(glm::length(sum) > k_opposite)) return candidate;
    const Vec3 mean = glm::normalize(sum);
    candidate.directions.push_back(mean);
    for (const int f : facets) {
        // Of planes that are no stone's one may face the other way.
        const Vec3 between = mean + shape.normals[std::size_t(f)];
        if (glm::length(between) > k_opposite) {
            candidate.directions.push_back(glm::normalize(between));
        }
    }
    candidate.facets = std::move(facets);
    return candidate;
}

std::vector<Candidate> candidates_of(const System& system, const Shape& shape) {
    std::vector<Candidate> candidates;
    for (const std::vector<int>& facets : system.edges().facets_of_vertex) {
        candidates.push_back(candidate_at(shape, facets));
    }
    for (const Edge& edge : system.edges().edges) {
        candidates.push_back(candidate_at(shape, {edge.left, edge.right}));
    }
    std::erase_if(candidates, [](const Candidate& c) { return c.directions.empty(); });
    return candidates;
}

struct Explanation {
    const Candidate* candidate = nullptr;
    double gain = 0, depth = 0, sigma = 0;
    std::vector<std::pair<Index, double>> signature;
    Eigen::VectorXd change;
};

// The best depth of one plane, when it beats `least`.
void try_direction(const Signatures& signatures, const Remains& remains, const Candidate& candidate,
                   const Vec3& direction, double least, Explanation& best) {
    const CornerNet& net = signatures.net();
    const int top = net.highest(candidate.facets, direction);
    if (top < 0) return;
    const double highest = glm::dot(direction, net.places()[std::size_t(top)]);
    // A facet is gone once its lowest corner is.
    double deepest = 1e300;
    for (const int f : candidate.facets) {
        const int bottom = net.highest({f}, -direction);
        if (bottom < 0) return;
        deepest =
            std::min(deepest, highest - glm::dot(direction, net.places()[std::size_t(bottom)]));
    }
    int far_off = 0;
    bool hopeless = false;
    const auto try_depth = [&](double depth) {
        const Plane plane{direction, highest - depth};
        const auto off = net.above(plane, top);
        if (!off) return 0.0;
        const std::vector<Index> touched = signatures.touched_by(*off);
        // Less deep, the plane changes no other equations.
        hopeless = touched.size() <= k_most_asked &&
                   !(remains.most_of(touched) > std::max(least, best.gain));
        if (hopeless) return 0.0;
        auto signature = signatures.of(plane, *off, touched);
        double slope = 0;
        for (const auto& [i, s] : signature) slope += remains.values()(i) * s;
        // The most that it could bring: R is a projection and r lies in it, so that
        // s'Rs >= (s'r)^2 / r'r (Cauchy and Schwarz).
        if (!(-2 * slope - slope * slope / remains.squares() > std::max(least, best.gain))) {
            return 0.0;
        }
        const Eigen::VectorXd change = remains.seen(signature);
        double square = 0, along = 0;
        for (const auto& [i, s] : signature) {
            square += s * change(i);
            along += remains.values()(i) * s;
        }
        const double gain = -2 * along - square;
        if (gain > std::max(least, best.gain)) {
            // Signatures grow in proportion to the depth, nearly.
            best = {&candidate,           gain,  depth, depth / std::sqrt(std::max(1e-300, square)),
                    std::move(signature), change};
        }
        // Whatever the depth, were the signature in proportion to it: hardly a part of what counts.
        if (along * along < k_far_from * least * square) ++far_off;
        return square > 0 ? -along / square : 0.0;  // by which to multiply the depth
    };
    for (int k = 1; k <= k_depths && far_off < 2 && !hopeless; ++k) {
        const double depth = deepest * std::pow(k_next_depth, k);
        const double before = best.gain;
        const double factor = try_depth(depth);
        if (best.gain > before && factor > k_next_depth && factor < 1 / k_next_depth) {
            try_depth(depth * factor);
        }
    }
}

}  // namespace

std::vector<ExtraFacet> suspect_extra_facets(const System& system, const Finished& finished,
                                             const Linearised& linear, const Diagnosis& diagnosis,
                                             double significance) {
    std::vector<ExtraFacet> found;
    if (!system.stone().convex || !finished.outline || !diagnosis.covariance) return found;
    // What is left would not agree, see below.
    if (diagnosis.throughout) return found;
    const Signatures signatures(system, finished.shape, *finished.outline, linear);
    Remains remains(linear, *diagnosis.covariance);
    std::vector<Candidate> candidates = candidates_of(system, finished.shape);
    double planes = 0, equations = 0;
    for (const Candidate& c : candidates) planes += double(c.directions.size());
    for (const Equation& e : linear.soft) equations += e.is_counted() ? e.readings() : 0;
    // One-sided, and two-sided.
    const double z = two_sided_normal_quantile(2 * significance / std::max(1.0, planes));
    const double enough = z * z, enough_single = diagnosis.suspect_limit * diagnosis.suspect_limit;
    const double handicap = 2 * std::log(std::max(1.0, planes / (2 * std::max(1.0, equations))));
    double taken = 0;
    for (int round = 0; round < k_most_rounds; ++round) {
        Index single = -1;
        for (Index i = 0; i < remains.size(); ++i) {
            if (remains.gain_of(i) > enough_single &&
                (single < 0 || remains.gain_of(i) > remains.gain_of(single))) {
                single = i;
            }
        }
        Explanation best;
        for (const Candidate& candidate : candidates) {
            for (const Vec3& direction : candidate.directions) {
                try_direction(signatures, remains, candidate, direction, enough, best);
            }
        }
        if (best.candidate == nullptr && single < 0) break;
        const double gain_of_single = single < 0 ? 0 : remains.gain_of(single);
        // As good as one wrong reading: both are said, and the reading is believed.
        const bool is_rival =
            best.candidate != nullptr && best.gain - handicap > gain_of_single - k_alternative;
        ++taken;
        ExtraFacet facet;
        if (is_rival) {
            Index strongest = -1;
            for (const auto& [i, s] : best.signature) {
                if (!(std::abs(s) > 1) || !(s * remains.values()(i) < 0)) continue;
                const int reading = linear.soft[std::size_t(i)].reading;
                facet.shown_by.push_back(system.readings()[std::size_t(reading)].id);
                if (strongest < 0 || remains.gain_of(i) > remains.gain_of(strongest)) strongest = i;
            }
            if (strongest >= 0 && remains.gain_of(strongest) > best.gain - k_alternative) {
                facet.or_wrong =
                    system.readings()[std::size_t(linear.soft[std::size_t(strongest)].reading)].id;
            }
            for (const int f : best.candidate->facets) {
                facet.at.push_back(system.stone().solid.facets[std::size_t(f)].name);
            }
            facet.depth = best.depth;
            facet.sigma = best.sigma;
            facet.chi2 = best.gain;
            facet.p = 0.5 * std::erfc(std::sqrt(0.5 * best.gain));
        }
        // What is left at a place once a facet there is taken out says nothing new.
        const bool known = std::any_of(found.begin(), found.end(),
                                       [&](const ExtraFacet& f) { return f.at == facet.at; });
        if (is_rival && !known && (facet.or_wrong.empty() || facet.depth < k_overlooked)) {
            found.push_back(std::move(facet));
        }
        if (single >= 0 && (!is_rival || gain_of_single > best.gain - k_alternative)) {
            remains.set_aside(single);
        } else {
            remains.add(best.change);
        }
    }
    // What is left must agree: where many readings contradict each other anything looks better.
    const double left = remains.values().squaredNorm();
    if (chi2_tail(left, std::max(1.0, diagnosis.dof - taken)) < significance) return {};
    std::stable_sort(found.begin(), found.end(),
                     [](const ExtraFacet& a, const ExtraFacet& b) { return a.chi2 > b.chi2; });
    return found;
}

}  // namespace culet
