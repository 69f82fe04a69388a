#include "fit/findings/meet_tests.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "fit/uncertainty/miss_covariance.h"
#include "fit/uncertainty/statistics.h"

namespace culet {

namespace {

// One meet: which incidences, and the directions in which its planes can miss each other.
struct Meet {
    int point = -1;
    MeetTreatment how = MeetTreatment::exact;
    std::vector<int> facets;
    std::vector<Eigen::Index> equations;  // exact: among the hard ones
    Eigen::MatrixXd together, apart;      // facets x 3 and x (facets - 3): [Q U] is orthogonal
    Eigen::Index first = 0;               // of its columns among all of its kind
};

// Planes N x = d have a common point when U'd = 0 with U spanning null(N').
void find_ways_apart(const Shape& shape, Meet& meet) {
    const std::vector<int>& facets = meet.facets;
    const Eigen::Index count = Eigen::Index(facets.size());
    Eigen::MatrixXd normals(count, 3);
    for (Eigen::Index i = 0; i < count; ++i) {
        const Vec3& n = shape.normals[facets[std::size_t(i)]];
        normals.row(i) << n.x, n.y, n.z;
    }
    const Eigen::HouseholderQR<Eigen::MatrixXd> qr(normals);
    const Eigen::MatrixXd q = qr.householderQ();
    meet.together = q.leftCols(3);
    meet.apart = q.rightCols(count - 3);
}

// Of a meet whose images under an exact symmetry hold, nothing is left to test: its planes are
// images of theirs.
std::vector<bool> held_by_images(const System& system) {
    const Parameters parameters = system.parameters();
    std::vector<bool> held;
    for (const OrbitMember& m : parameters.orbits().points) {
        held.push_back(parameters.images_of_point(m.first) > 1);
    }
    return held;
}

std::vector<Meet> meets_of(const System& system, const Shape& shape, const Inference& inference) {
    std::vector<Meet> meets(shape.points.size());
    const std::vector<Incidence>& incidences = system.incidences();
    for (const Incidence& incidence : incidences) {
        Meet& meet = meets[std::size_t(incidence.point)];
        meet.point = incidence.point;
        meet.facets.push_back(incidence.facet);
        meet.how = std::max(meet.how, incidence.how);
    }
    const std::vector<Equation>& hard = inference.linear().hard;
    for (std::size_t i = 0; i < hard.size(); ++i) {
        if (hard[i].incidence < 0) continue;
        meets[std::size_t(incidences[std::size_t(hard[i].incidence)].point)].equations.push_back(
            Eigen::Index(i));
    }
    std::erase_if(meets, [](const Meet& meet) { return meet.facets.size() < 4; });
    for (Meet& meet : meets) {
        find_ways_apart(shape, meet);
        if (meet.equations.size() == meet.facets.size()) continue;
        // Partly exact: tested by what came out, like a soft one.
        if (meet.how == MeetTreatment::exact) meet.how = MeetTreatment::soft;
    }
    return meets;
}

// What `x` and its covariance become when the directions [first, first + count) are let go.
void let_go(Eigen::VectorXd& x, Eigen::MatrixXd& v, Eigen::Index first, Eigen::Index count) {
    const Eigen::MatrixXd own = v.block(first, first, count, count);
    const Eigen::MatrixXd inverse = own.completeOrthogonalDecomposition().pseudoInverse();
    const Eigen::MatrixXd across = v.middleCols(first, count) * inverse;
    const Eigen::VectorXd gone = x.segment(first, count);
    const Eigen::MatrixXd rows = v.middleRows(first, count);
    x -= across * gone;
    v -= across * rows;
    x.segment(first, count).setZero();
    v.middleRows(first, count).setZero();
    v.middleCols(first, count).setZero();
}

// What the readings pull exact meets apart with, and its covariance.
struct ExactMeets {
    Eigen::VectorXd pulls;
    Eigen::MatrixXd covariance;
};
ExactMeets exact_meets(const std::vector<Meet>& meets, Eigen::Index columns,
                       const Inference& inference) {
    const Eigen::Index hard = Eigen::Index(inference.linear().hard.size());
    std::vector<Eigen::Triplet<double>> apart, together;
    std::vector<bool> is_kept(std::size_t(hard), true);
    Eigen::Index kept = 0;
    const auto put = [](const Meet& meet, const Eigen::MatrixXd& ways, Eigen::Index first,
                        std::vector<Eigen::Triplet<double>>& to) {
        for (Eigen::Index i = 0; i < ways.rows(); ++i) {
            for (Eigen::Index k = 0; k < ways.cols(); ++k) {
                to.emplace_back(first + k, meet.equations[std::size_t(i)], ways(i, k));
            }
        }
    };
    for (const Meet& meet : meets) {
        put(meet, meet.apart, meet.first, apart);
        put(meet, meet.together, kept, together);
        kept += meet.together.cols();
        for (const Eigen::Index i : meet.equations) is_kept[std::size_t(i)] = false;
    }
    for (Eigen::Index i = 0; i < hard; ++i) {
        if (is_kept[std::size_t(i)]) together.emplace_back(kept++, i, 1.0);
    }
    Combinations tested(columns, hard), others(kept, hard);
    tested.setFromTriplets(apart.begin(), apart.end());
    others.setFromTriplets(together.begin(), together.end());
    ExactMeets result;
    result.pulls = tested * inference.multipliers();
    if (const auto misses = miss_covariance(inference.linear(), others, tested)) {
        result.covariance =
            misses->llt().solve(Eigen::MatrixXd::Identity(misses->rows(), misses->cols()));
    } else {
        result.covariance = inference.multiplier_covariance(Eigen::MatrixXd(tested.transpose()));
    }
    return result;
}

// Estimated miss of the plane that is furthest off, and its sigma, from misses along U.
void set_miss(MeetFinding& finding, const Meet& meet, const Eigen::VectorXd& along,
              const Eigen::MatrixXd& covariance) {
    const Eigen::VectorXd misses = meet.apart * along;
    Eigen::Index worst = 0;
    misses.cwiseAbs().maxCoeff(&worst);
    finding.miss = std::abs(misses(worst));
    const Eigen::RowVectorXd row = meet.apart.row(worst);
    const double variance = (row * covariance * row.transpose())(0);
    finding.sigma = variance >= 0.25 ? std::numeric_limits<double>::infinity()
                                     : std::sqrt(std::max(0.0, variance));
}

}  // namespace

std::vector<MeetFinding> test_meets(const System& system, const Shape& shape,
                                    const Inference& inference, const MeetTestOptions& options) {
    std::vector<Meet> meets = meets_of(system, shape, inference);
    Eigen::Index exact_columns = 0, all_columns = 0;
    const std::vector<bool> held = held_by_images(system);
    const auto is_tested = [&](const Meet& meet) {
        return meet.how == MeetTreatment::exact && (held.empty() || !held[std::size_t(meet.point)]);
    };
    for (Meet& meet : meets) {
        all_columns += meet.apart.cols();
        if (!is_tested(meet)) continue;
        meet.first = exact_columns;
        exact_columns += meet.apart.cols();
    }
    if (all_columns > k_most_tested) return {};
    std::vector<MeetFinding> findings(meets.size());
    for (std::size_t m = 0; m < meets.size(); ++m) {
        MeetFinding& finding = findings[m];
        for (int f : meets[m].facets) {
            finding.facets.push_back(system.stone().solid.facets[std::size_t(f)].name);
        }
        finding.how = meets[m].how == MeetTreatment::exact  ? "exact"
                      : meets[m].how == MeetTreatment::soft ? "soft"
                                                            : "released";
        finding.conditions = static_cast<int>(meets[m].apart.cols());
    }
    // A miss is tested when the readings tell it to better than half of the half diameter, and is
    // free to be at all when other exact conditions leave it more than rounding.
    constexpr double k_told = 0.25, k_free = 1e-18;

    // Exact meets. V^-1 is the covariance of misses: v in [1 / told, 1 / free].
    std::vector<Meet> tested;
    for (const Meet& meet : meets) {
        if (is_tested(meet)) tested.push_back(meet);
    }
    const ExactMeets exact = exact_meets(tested, exact_columns, inference);
    Eigen::MatrixXd v = exact.covariance;
    Eigen::VectorXd x = exact.pulls;
    const double level = options.significance / std::max<double>(1, double(meets.size()));
    std::vector<bool> gone(meets.size(), false);
    for (bool first_round = true;; first_round = false) {
        std::size_t worst = meets.size();
        double least_p = level, most = 0;
        for (std::size_t m = 0; m < meets.size(); ++m) {
            if (!is_tested(meets[m]) || gone[m]) continue;
            const Eigen::Index k = meets[m].apart.cols();
            const Eigen::MatrixXd own = v.block(meets[m].first, meets[m].first, k, k);
            const Eigen::VectorXd pull = x.segment(meets[m].first, k);
            const QuadraticTest test = quadratic_test(pull, own, 1 / k_told, 1 / k_free);
            MeetFinding& finding = findings[m];
            if (first_round) {
                finding.chi2 = test.statistic;
                finding.tested = test.tested;
                finding.p = test.p;
                const Eigen::MatrixXd covariance =
                    (own + 1e-12 * Eigen::MatrixXd::Identity(k, k)).inverse();
                set_miss(finding, meets[m], covariance * pull, covariance);
            }
            // Of several beyond the reach of p the larger statistic.
            if (test.p < level && (test.p < least_p || (test.p == 0 && test.statistic > most))) {
                least_p = test.p;
                most = test.statistic;
                worst = m;
            }
        }
        if (worst == meets.size() || most <= options.least_chi2) break;
        MeetFinding& finding = findings[worst];
        const Eigen::Index k = meets[worst].apart.cols();
        const Eigen::MatrixXd covariance = (v.block(meets[worst].first, meets[worst].first, k, k) +
                                            1e-12 * Eigen::MatrixXd::Identity(k, k))
                                               .inverse();
        set_miss(finding, meets[worst], covariance * x.segment(meets[worst].first, k), covariance);
        finding.contradicted = true;
        finding.chi2 = most;
        finding.p = least_p;
        gone[worst] = true;
        let_go(x, v, meets[worst].first, k);
    }

    // The others, by the misses that came out.
    for (std::size_t m = 0; m < meets.size(); ++m) {
        const Meet& meet = meets[m];
        if (meet.how == MeetTreatment::exact) continue;
        const Vec3 at = shape.points[std::size_t(meet.point)];
        std::vector<Quantity> heights;
        Eigen::VectorXd offsets(Eigen::Index(meet.facets.size()));
        for (std::size_t i = 0; i < meet.facets.size(); ++i) {
            const int f = meet.facets[i];
            // How far the plane passes a fixed place: the point's own motion drops out of U'.
            Quantity q;
            q.value = glm::dot(shape.normals[std::size_t(f)], at) - shape.offsets[std::size_t(f)];
            q.add(Quantity::By::normal, f, at);
            q.add(Quantity::By::offset, f, -1.0);
            offsets(Eigen::Index(i)) = q.value;
            heights.push_back(std::move(q));
        }
        const Eigen::MatrixXd u = meet.apart;
        const Eigen::VectorXd along = u.transpose() * offsets;
        const Eigen::MatrixXd covariance =
            u.transpose() * inference.covariance(inference.rows_of(heights)) * u;
        MeetFinding& finding = findings[m];
        const QuadraticTest test = quadratic_test(along, covariance, k_free, k_told);
        finding.chi2 = test.statistic;
        finding.tested = test.tested;
        finding.p = test.p;
        set_miss(finding, meet, along, covariance);
        if (meet.how != MeetTreatment::soft) continue;
        // A soft meet is contradicted when its misses are too large for the sigma that it was
        // given: residuals against their own covariance, sigma^2 - what the fit knows.
        Eigen::VectorXd sigma(offsets.size());
        for (std::size_t i = 0; i < meet.facets.size(); ++i) {
            for (const Incidence& incidence : system.incidences()) {
                if (incidence.point != meet.point || incidence.facet != meet.facets[i]) continue;
                sigma(Eigen::Index(i)) =
                    incidence.sigma > 0 ? incidence.sigma
                                        : system.group_sigmas()[system.is_girdle(meet.facets[i])];
            }
        }
        const Eigen::MatrixXd left =
            u.transpose() * Eigen::MatrixXd(sigma.cwiseAbs2().asDiagonal()) * u - covariance;
        const double size = sigma.squaredNorm() / double(sigma.size());
        const QuadraticTest soft = quadratic_test(along, left, 1e-4 * size, 1e300);
        finding.contradicted = soft.tested > 0 && soft.p < level;
        if (finding.contradicted) {
            finding.chi2 = soft.statistic;
            finding.p = soft.p;
        }
    }
    return findings;
}

}  // namespace culet
