#include "fit/findings/meet_tests.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "fit/model/equations.h"
#include "fit/uncertainty/condition_tests.h"
#include "fit/uncertainty/statistics.h"
#include "stone/numbers/dense_algebra.h"

namespace culet {

namespace {

// Variances. A miss is tested if the readings determine it to half of the half diameter, and other
// exact conditions leave it more than rounding error.
constexpr double k_told = 0.25, k_free = 1e-18;

struct Meet {
    int point = -1;
    MeetTreatment how = MeetTreatment::exact;
    std::vector<int> facets;
    std::vector<Eigen::Index> equations;  // exact: among the hard ones
    Eigen::MatrixXd together, apart;  // facets x 3 and facets x (facets - 3): [Q U] is orthogonal
    bool has_score = false;           // exact, and not implied by its images: has multipliers
    Eigen::Index first = 0;           // of its columns among all with a score
};

// Planes N x = d have a common point if U'd = 0, where U spans null(N').
void find_ways_apart(const Shape& shape, Meet& meet) {
    const std::vector<int>& facets = meet.facets;
    const Eigen::Index count = Eigen::Index(facets.size());
    Eigen::MatrixXd normals(count, 3);
    for (Eigen::Index i = 0; i < count; ++i) {
        const Vec3& n = shape.normals[facets[std::size_t(i)]];
        normals.row(i) << n.x, n.y, n.z;
    }
    const Eigen::MatrixXd q = completed_basis(normals);
    meet.together = q.leftCols(3);
    meet.apart = q.rightCols(count - 3);
}

// A meet with images under an exact symmetry cannot be tested: its planes are images of theirs.
std::vector<bool> held_by_images(const FitModel& model) {
    const Parameters parameters = model.parameters();
    std::vector<bool> held;
    for (const OrbitMember& m : parameters.orbits().points) {
        held.push_back(parameters.images_of_point(m.first) > 1);
    }
    return held;
}

std::vector<Meet> meets_of(const FitModel& model, const Shape& shape,
                           const Covariance& covariance) {
    std::vector<Meet> meets(shape.points.size());
    const std::vector<Incidence>& incidences = model.meets().incidences;
    for (const Incidence& incidence : incidences) {
        Meet& meet = meets[std::size_t(incidence.point)];
        meet.point = incidence.point;
        meet.facets.push_back(incidence.facet);
        meet.how = std::max(meet.how, incidence.how);
    }
    const std::vector<Equation>& hard = covariance.linear().hard;
    for (std::size_t i = 0; i < hard.size(); ++i) {
        if (hard[i].incidence < 0) continue;
        meets[std::size_t(incidences[std::size_t(hard[i].incidence)].point)].equations.push_back(
            Eigen::Index(i));
    }
    std::erase_if(meets, [](const Meet& meet) { return meet.facets.size() < 4; });
    for (Meet& meet : meets) {
        find_ways_apart(shape, meet);
        if (meet.equations.size() == meet.facets.size()) continue;
        // Partly exact: tested by its misses, like a soft one.
        if (meet.how == MeetTreatment::exact) meet.how = MeetTreatment::soft;
    }
    const std::vector<bool> held = held_by_images(model);
    Eigen::Index columns = 0;
    for (Meet& meet : meets) {
        meet.has_score =
            meet.how == MeetTreatment::exact && (held.empty() || !held[std::size_t(meet.point)]);
        if (!meet.has_score) continue;
        meet.first = columns;
        columns += meet.apart.cols();
    }
    return meets;
}

// Lagrange multipliers of the exact meets, and their covariance.
Multipliers exact_meets(const std::vector<Meet>& meets, const Linearised& linear) {
    const Eigen::Index hard = Eigen::Index(linear.hard.size());
    std::vector<Eigen::Triplet<double>> apart, together;
    std::vector<bool> is_kept(std::size_t(hard), true);
    Eigen::Index columns = 0, kept = 0;
    const auto put = [](const Meet& meet, const Eigen::MatrixXd& ways, Eigen::Index first,
                        std::vector<Eigen::Triplet<double>>& to) {
        for (Eigen::Index i = 0; i < ways.rows(); ++i) {
            for (Eigen::Index k = 0; k < ways.cols(); ++k) {
                to.emplace_back(first + k, meet.equations[std::size_t(i)], ways(i, k));
            }
        }
    };
    for (const Meet& meet : meets) {
        if (!meet.has_score) continue;
        put(meet, meet.apart, meet.first, apart);
        put(meet, meet.together, kept, together);
        columns += meet.apart.cols();
        kept += meet.together.cols();
        for (const Eigen::Index i : meet.equations) is_kept[std::size_t(i)] = false;
    }
    for (Eigen::Index i = 0; i < hard; ++i) {
        if (is_kept[std::size_t(i)]) together.emplace_back(kept++, i, 1.0);
    }
    Combinations tested(columns, hard), others(kept, hard);
    tested.setFromTriplets(apart.begin(), apart.end());
    others.setFromTriplets(together.begin(), together.end());
    return multipliers_of(keeping(linear, others), tested * linear.hard_rows,
                          tested * linear.hard_residuals);
}

// Sets the miss of the plane furthest off and its sigma, from misses along U.
void set_miss(MeetFinding& finding, const Meet& meet, const Eigen::VectorXd& along,
              const Eigen::MatrixXd& covariance) {
    const Eigen::VectorXd misses = meet.apart * along;
    Eigen::Index worst = 0;
    misses.cwiseAbs().maxCoeff(&worst);
    finding.miss = std::abs(misses(worst));
    const Eigen::RowVectorXd row = meet.apart.row(worst);
    const double variance = row.dot(covariance * row.transpose());
    finding.sigma = variance >= 0.25 ? std::numeric_limits<double>::infinity()
                                     : std::sqrt(std::max(0.0, variance));
}

// Conditions the other multipliers on the release of one meet.
void release_meet(Multipliers& exact, const Meet& meet) {
    const Eigen::Index first = meet.first, count = meet.apart.cols();
    Eigen::MatrixXd& v = exact.covariance;
    const Eigen::MatrixXd rows = v.middleRows(first, count);
    const Eigen::MatrixXd across =
        product(v.middleCols(first, count), pseudo_inverse(rows.middleCols(first, count)));
    exact.values -= across * Eigen::VectorXd(exact.values.segment(first, count));
    v -= product(across, rows);
    exact.values.segment(first, count).setZero();
    v.middleRows(first, count).setZero();
    v.middleCols(first, count).setZero();
}

// V^-1 is the covariance of misses, so V is in [1 / told, 1 / free].
void set_score(const Multipliers& exact, const Meet& meet, MeetFinding& finding) {
    const Eigen::Index k = meet.apart.cols();
    const Eigen::VectorXd pull = exact.values.segment(meet.first, k);
    const Eigen::MatrixXd v = exact.covariance.block(meet.first, meet.first, k, k);
    const QuadraticTest test = quadratic_test(pull, v, 1 / k_told, 1 / k_free);
    const Eigen::MatrixXd covariance = inverse_of(v + 1e-12 * Eigen::MatrixXd::Identity(k, k));
    set_miss(finding, meet, covariance * pull, covariance);
    finding.chi2 = test.statistic;
    finding.p = test.p;
    finding.tested = test.tested;
}

void test_exact_meets(const std::vector<Meet>& meets, Multipliers exact, double level,
                      double least_chi2, std::vector<MeetFinding>& findings) {
    std::vector<std::size_t> held;
    for (std::size_t m = 0; m < meets.size(); ++m) {
        if (meets[m].has_score) held.push_back(m);
    }
    std::vector<MeetFinding> now = findings;
    for (bool is_first = true;; is_first = false) {
        for (const std::size_t m : held) set_score(exact, meets[m], now[m]);
        if (is_first) findings = now;
        // Among several whose p is rounded to zero, the larger statistic.
        const auto worst = std::min_element(held.begin(), held.end(), [&](auto a, auto b) {
            return std::pair(now[a].p, -now[a].chi2) < std::pair(now[b].p, -now[b].chi2);
        });
        if (worst == held.end() || !(now[*worst].p < level) || now[*worst].chi2 <= least_chi2) {
            return;
        }
        findings[*worst] = now[*worst];
        findings[*worst].contradicted = true;
        release_meet(exact, meets[*worst]);
        held.erase(worst);
    }
}

// How far each plane passes a fixed place. The point's own motion drops out of U'.
std::vector<Quantity> heights_of(const Shape& shape, const Meet& meet) {
    const Vec3 at = shape.points[std::size_t(meet.point)];
    std::vector<Quantity> heights;
    for (const int f : meet.facets) {
        Quantity q;
        q.value = glm::dot(shape.normals[std::size_t(f)], at) - shape.offsets[std::size_t(f)];
        q.add(Quantity::By::normal, f, at);
        q.add(Quantity::By::offset, f, -1.0);
        heights.push_back(std::move(q));
    }
    return heights;
}

void test_misses(const Shape& shape, const Covariance& all, const Meet& meet,
                 MeetFinding& finding) {
    const std::vector<Quantity> heights = heights_of(shape, meet);
    Eigen::VectorXd offsets(Eigen::Index(heights.size()));
    for (std::size_t i = 0; i < heights.size(); ++i) offsets(Eigen::Index(i)) = heights[i].value;
    const Eigen::MatrixXd& u = meet.apart;
    const Eigen::VectorXd along = u.transpose() * offsets;
    const Eigen::MatrixXd covariance =
        congruence(u, all.joint(all.linear().writer.functions(heights)));
    const QuadraticTest test = quadratic_test(along, covariance, k_free, k_told);
    finding.chi2 = test.statistic;
    finding.tested = test.tested;
    finding.p = test.p;
    set_miss(finding, meet, along, covariance);
}

MeetFinding untested(const FitModel& model, const Meet& meet) {
    MeetFinding finding;
    for (const int f : meet.facets) {
        finding.facets.push_back(model.stone().solid.facets[std::size_t(f)].name);
    }
    finding.how = name_of(meet.how);
    finding.conditions = static_cast<int>(meet.apart.cols());
    return finding;
}

}  // namespace

std::vector<MeetFinding> test_meets(const FitModel& model, const Shape& shape,
                                    const Covariance& covariance, double significance,
                                    double least_chi2) {
    const std::vector<Meet> meets = meets_of(model, shape, covariance);
    Eigen::Index conditions = 0;
    for (const Meet& meet : meets) conditions += meet.apart.cols();
    if (conditions > k_most_tested) return {};
    const double level = significance / std::max<double>(1, double(meets.size()));
    std::vector<MeetFinding> findings;
    for (const Meet& meet : meets) findings.push_back(untested(model, meet));
    test_exact_meets(meets, exact_meets(meets, covariance.linear()), level, least_chi2, findings);
    for (std::size_t m = 0; m < meets.size(); ++m) {
        if (meets[m].how == MeetTreatment::exact) continue;
        test_misses(shape, covariance, meets[m], findings[m]);
    }
    return findings;
}

}  // namespace culet
