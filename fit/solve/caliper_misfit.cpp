#include "fit/solve/caliper_misfit.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "fit/model/orbits.h"
#include "stone/dense_algebra.h"

namespace culet {

namespace {

// In how many rounds it is settled which corners the jaws touch.
constexpr int k_most_contacts = 4;

using Caliper = Relaxation::Caliper;

struct Jaws {
    int first = -1, second = -1;
    Vec3 direction{0, 0, 0};  // as the stone sees it
    bool operator==(const Jaws&) const = default;
};

// With corners at these places. Of those that were not asked none is touched, unless all may be.
std::vector<Jaws> jaws_at(const std::vector<Caliper>& calipers, const Corners& corners,
                          const std::vector<Vec3>& places, double angle, bool all_may_be) {
    std::vector<Jaws> all;
    const glm::dmat3 back = turn_about_z(-angle);
    for (const Caliper& caliper : calipers) {
        const Vec3 d = back * caliper.direction;
        Jaws jaws{-1, -1, d};
        double high = -1e300, low = 1e300;
        for (const int c : *caliper.corners) {
            if (!all_may_be && corners.column[std::size_t(c)] < 0) continue;
            const double at = glm::dot(places[std::size_t(c)], d);
            if (at > high) {
                high = at;
                jaws.first = c;
            }
            if (at < low) {
                low = at;
                jaws.second = c;
            }
        }
        all.push_back(jaws);
    }
    return all;
}

// With jaws on these corners, at this turn and a little around it.
CaliperMisfit misfit_of(const std::vector<Caliper>& calipers, const Corners& corners,
                        const std::vector<Jaws>& jaws, double around) {
    const auto count = static_cast<Eigen::Index>(calipers.size());
    Eigen::VectorXd off(count), slope(count);
    Eigen::MatrixXd covariance(count, count);
    for (Eigen::Index i = 0; i < count; ++i) {
        const Jaws& a = jaws[std::size_t(i)];
        const Caliper& caliper = calipers[std::size_t(i)];
        const Vec3 between =
            corners.places[std::size_t(a.first)] - corners.places[std::size_t(a.second)];
        off(i) = glm::dot(a.direction, between) - caliper.value;
        slope(i) = glm::dot(Vec3{a.direction.y, -a.direction.x, 0}, between);
        for (Eigen::Index k = 0; k <= i; ++k) {
            const Jaws& b = jaws[std::size_t(k)];
            covariance(i, k) = covariance(k, i) =
                corners.covariance_of(a.first, a.direction, b.first, b.direction) -
                corners.covariance_of(a.first, a.direction, b.second, b.direction) -
                corners.covariance_of(a.second, a.direction, b.first, b.direction) +
                corners.covariance_of(a.second, a.direction, b.second, b.direction);
        }
        covariance(i, i) += caliper.sigma * caliper.sigma;
    }
    const PivotedCholesky factor(covariance);
    CaliperMisfit result;
    if (!factor.is_positive()) {
        result.chi2 = std::numeric_limits<double>::infinity();
        return result;
    }
    const double downhill = slope.dot(factor.solve_one(off)), bend = factor.square(slope);
    const double move = bend > 0 ? std::clamp(-downhill / bend, -around, around) : 0;
    off += move * slope;
    const Eigen::VectorXd pull = factor.solve_one(off);
    result.chi2 = off.dot(pull);
    result.forces = Eigen::VectorXd::Zero(corners.covariance.cols());
    for (Eigen::Index i = 0; i < count; ++i) {
        const Jaws& j = jaws[std::size_t(i)];
        for (const int axis : {0, 1}) {
            const double force = pull(i) * j.direction[axis];
            result.forces(corners.column[std::size_t(j.first)] + axis) -= force;
            result.forces(corners.column[std::size_t(j.second)] + axis) += force;
        }
    }
    return result;
}

}  // namespace

void number_touched(const std::vector<Caliper>& calipers, double angle, Corners& corners) {
    for (const Jaws& j : jaws_at(calipers, corners, corners.places, angle, true)) {
        for (const int corner : {j.first, j.second}) {
            Eigen::Index& column = corners.column[std::size_t(corner)];
            if (column >= 0) continue;
            column = 2 * Eigen::Index(corners.touched.size());
            corners.touched.push_back(corner);
        }
    }
}

CaliperMisfit misfit_at(const std::vector<Caliper>& calipers, const Corners& corners, double angle,
                        double around) {
    std::vector<Jaws> jaws = jaws_at(calipers, corners, corners.places, angle, false);
    CaliperMisfit before;
    for (int round = 0; round < k_most_contacts; ++round) {
        CaliperMisfit misfit = misfit_of(calipers, corners, jaws, around);
        if (!std::isfinite(misfit.chi2)) return misfit;
        std::vector<Vec3> places = corners.places;
        const Eigen::VectorXd shifts = corners.covariance * misfit.forces;
        for (std::size_t p = 0; p < places.size(); ++p) {
            if (corners.column[p] < 0) continue;
            places[p].x += shifts(corners.column[p]);
            places[p].y += shifts(corners.column[p] + 1);
        }
        std::vector<Jaws> next = jaws_at(calipers, corners, places, angle, false);
        if (next == jaws || (round + 1 == k_most_contacts && misfit.chi2 > before.chi2)) {
            return misfit;
        }
        before = std::move(misfit);
        jaws = std::move(next);
    }
    return before;
}

}  // namespace culet
