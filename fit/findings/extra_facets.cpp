#include "fit/findings/extra_facets.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "fit/uncertainty/error_signatures.h"
#include "fit/uncertainty/restricted_residuals.h"
#include "fit/uncertainty/statistics.h"

namespace culet {

namespace {

using Index = Eigen::Index;

// Directions whose sum is shorter face away from each other: no direction lies between them.
constexpr double k_opposite = 1e-6;
// Rounds of looking for one more explanation.
constexpr int k_most_rounds = 16;
// Planes that change more equations than this are tried without asking first what they may bring.
constexpr std::size_t k_most_asked = 48;
// Twice the log of the likelihood ratio below which two explanations are as good as each other.
constexpr double k_alternative = 3;
// Shown by a single reading, only what one may well overlook: of the half diameter.
constexpr double k_overlooked = 0.1;
// Depths tried: each this part of the one before.
constexpr double k_next_depth = 0.7;
constexpr int k_depths = 24;
// A direction is left after two depths from which the best multiple would bring so little.
constexpr double k_far_from = 0.25;

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
    RestrictedResiduals::Signature signature;
};

// The best depth of one plane, when it beats `least`.
void try_direction(const ErrorSignatures& signatures, const RestrictedResiduals& restricted,
                   const Candidate& candidate, const Vec3& direction, double least,
                   Explanation& best) {
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
                   !(restricted.most_of(touched) > std::max(least, best.gain));
        if (hopeless) return 0.0;
        auto signature = signatures.of(plane, *off, touched);
        double slope = 0;
        for (const auto& [i, s] : signature) slope += restricted.values()(i) * s;
        // The most that it could bring: R is a projection and r lies in it, so that
        // s'Rs >= (s'r)^2 / r'r (Cauchy and Schwarz).
        if (!(-2 * slope - slope * slope / restricted.squares() > std::max(least, best.gain))) {
            return 0.0;
        }
        const double square = restricted.seen_square(signature);
        const double gain = -2 * slope - square;
        if (gain > std::max(least, best.gain)) {
            // Signatures grow in proportion to the depth, nearly.
            best = {&candidate, gain, depth, depth / std::sqrt(std::max(1e-300, square)),
                    std::move(signature)};
        }
        // Whatever the depth, were the signature in proportion to it: hardly a part of what counts.
        if (slope * slope < k_far_from * least * square) ++far_off;
        return square > 0 ? -slope / square : 0.0;  // by which to multiply the depth
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

Explanation best_plane(const ErrorSignatures& signatures, const RestrictedResiduals& restricted,
                       const std::vector<Candidate>& candidates, double least) {
    Explanation best;
    for (const Candidate& candidate : candidates) {
        for (const Vec3& direction : candidate.directions) {
            try_direction(signatures, restricted, candidate, direction, least, best);
        }
    }
    return best;
}

// The one that lowers chi-square most by its own error, when that beats `least`; or -1.
Index largest_outlier(const RestrictedResiduals& restricted, double least) {
    Index largest = -1;
    for (Index i = 0; i < restricted.size(); ++i) {
        if (restricted.gain_of(i) > least &&
            (largest < 0 || restricted.gain_of(i) > restricted.gain_of(largest))) {
            largest = i;
        }
    }
    return largest;
}

// Falls of chi-square that count.
struct Thresholds {
    double plane = 0, outlier = 0;  // significant at the level, shared out among all of a kind
    double handicap = 0;            // of a plane beside an outlier: there are more to choose from
};
Thresholds thresholds_of(const std::vector<Candidate>& candidates, const Linearised& linear,
                         const Diagnosis& diagnosis, double significance) {
    double planes = 0, equations = 0;
    for (const Candidate& c : candidates) planes += double(c.directions.size());
    for (const Equation& e : linear.soft) equations += e.is_counted() ? e.readings() : 0;
    // One-sided, and two-sided.
    const double z = two_sided_normal_quantile(2 * significance / std::max(1.0, planes));
    return {z * z, diagnosis.suspect_limit * diagnosis.suspect_limit,
            2 * std::log(std::max(1.0, planes / (2 * std::max(1.0, equations))))};
}

// The plane for people, with the readings that it explains by more than their sigma.
ExtraFacet described(const System& system, const Linearised& linear,
                     const RestrictedResiduals& restricted, const Explanation& plane) {
    const auto reading_id = [&](Index i) {
        return system.readings()[std::size_t(linear.soft[std::size_t(i)].reading)].id;
    };
    ExtraFacet facet;
    Index strongest = -1;
    for (const auto& [i, s] : plane.signature) {
        if (!(std::abs(s) > 1) || !(s * restricted.values()(i) < 0)) continue;
        facet.shown_by.push_back(reading_id(i));
        if (strongest < 0 || restricted.gain_of(i) > restricted.gain_of(strongest)) strongest = i;
    }
    if (strongest >= 0 && restricted.gain_of(strongest) > plane.gain - k_alternative) {
        facet.or_wrong = reading_id(strongest);
    }
    for (const int f : plane.candidate->facets) {
        facet.at.push_back(system.stone().solid.facets[std::size_t(f)].name);
    }
    facet.depth = plane.depth;
    facet.sigma = plane.sigma;
    facet.chi2 = plane.gain;
    facet.p = 0.5 * std::erfc(std::sqrt(0.5 * plane.gain));
    return facet;
}

// Worth saying: one reading alone may as well be wrong, unless the plane is easily overlooked; and
// what is left at a place once a facet there is taken out says nothing new.
bool is_news(const ExtraFacet& facet, const std::vector<ExtraFacet>& found) {
    const bool known = std::any_of(found.begin(), found.end(),
                                   [&](const ExtraFacet& f) { return f.at == facet.at; });
    return !known && (facet.or_wrong.empty() || facet.depth < k_overlooked);
}

}  // namespace

std::vector<ExtraFacet> suspect_extra_facets(const System& system, const Finished& finished,
                                             const Diagnosis& diagnosis, double significance) {
    std::vector<ExtraFacet> found;
    if (!system.stone().convex || !finished.outline || !diagnosis.covariance) return found;
    // What is left would not agree, see below.
    if (diagnosis.throughout) return found;
    const Linearised& linear = diagnosis.covariance->linear();
    const ErrorSignatures signatures(system, finished.shape, *finished.outline, linear);
    RestrictedResiduals restricted(*diagnosis.covariance);
    const std::vector<Candidate> candidates = candidates_of(system, finished.shape);
    const Thresholds least = thresholds_of(candidates, linear, diagnosis, significance);
    double taken = 0, most = 0;
    const auto agrees = [&](double left) {
        return chi2_tail(left, std::max(1.0, diagnosis.dof - taken)) >= significance;
    };
    for (int round = 0; round < k_most_rounds; ++round) {
        const Index outlier = largest_outlier(restricted, least.outlier);
        const Explanation plane = best_plane(signatures, restricted, candidates, least.plane);
        if (plane.candidate == nullptr && outlier < 0) break;
        const double outlier_gain = outlier < 0 ? 0 : restricted.gain_of(outlier);
        // What is left must agree: where many readings contradict each other anything looks better.
        // Each explanation is the best there is, and the next ones bring no more.
        most = std::max({most, plane.gain, outlier_gain});
        if (!agrees(restricted.values().squaredNorm() - (k_most_rounds - round) * most)) return {};
        // As good as one wrong reading: both are said, and the reading is believed.
        const bool is_rival = plane.candidate != nullptr &&
                              plane.gain - least.handicap > outlier_gain - k_alternative;
        ++taken;
        if (is_rival) {
            ExtraFacet facet = described(system, linear, restricted, plane);
            if (is_news(facet, found)) found.push_back(std::move(facet));
        }
        if (outlier >= 0 && (!is_rival || outlier_gain > plane.gain - k_alternative)) {
            restricted.leave_out(outlier);
        } else {
            restricted.add(restricted.seen(plane.signature));
        }
    }
    if (!agrees(restricted.values().squaredNorm())) return {};
    std::stable_sort(found.begin(), found.end(),
                     [](const ExtraFacet& a, const ExtraFacet& b) { return a.chi2 > b.chi2; });
    return found;
}

}  // namespace culet
