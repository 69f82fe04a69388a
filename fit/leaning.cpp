#include "fit/leaning.h"

#include <Eigen/Dense>
#include <cmath>

namespace culet {

namespace {

constexpr double k_damping = 1e-6;
// Of what one turn does to the others.
constexpr double k_precision = 1e-4;
// Of chi-square; less is not worth another round.
constexpr double k_least_gain = 0.01;
// A step this long in one of the freedoms is no longer linear.
constexpr double k_longest = 0.5;

}  // namespace

std::optional<Shape> leaning_better(Relaxation& relaxation, SaddleSolver& solver,
                                    const Shape& shape, const Softness& softness, double within,
                                    const std::vector<int>& sides) {
    relaxation.choose(shape, softness.incidence == 0);
    std::vector<Relaxation::Folded> folded = relaxation.folded(shape, within);
    std::erase_if(folded, [&](const Relaxation::Folded& f) {
        return !sides.empty() && sides[std::size_t(f.facet)] != 0;
    });
    if (folded.empty()) return std::nullopt;
    const Sheet sheet = relaxation.sheet(shape, softness);
    if (!solver.factor(sheet.rows, sheet.prior_stiffness + k_damping * relaxation.metric()))
        return std::nullopt;
    const auto count = static_cast<Eigen::Index>(folded.size());
    const Eigen::VectorXd none = Eigen::VectorXd::Zero(relaxation.freedoms().size());
    // A value that grows by its shift takes as much off the residual. Of what the turn of facet i
    // adds to chi-square, r(i) is half the part that is linear and big(i, i) the square one.
    Eigen::VectorXd r = Eigen::VectorXd::Zero(count);
    Eigen::MatrixXd shifts = Eigen::MatrixXd::Zero(sheet.rows.count(), count);
    for (Eigen::Index i = 0; i < count; ++i) {
        for (const auto& [row, shift] : folded[std::size_t(i)].turns) {
            r(i) -= shift * sheet.rows.residual[std::size_t(row)] /
                    sheet.rows.variance[std::size_t(row)];
            shifts(row, i) = shift;
        }
    }
    const auto solved = solver.solve_all(Eigen::MatrixXd(), shifts, k_precision);
    if (!solved.good) return std::nullopt;
    Eigen::MatrixXd big = Eigen::MatrixXd::Zero(count, count);
    for (Eigen::Index k = 0; k < count; ++k) {
        for (const auto& [row, shift] : folded[std::size_t(k)].turns) {
            // forces = (J x - b) / variance
            big.row(k) -= shift * solved.forces.row(row);
        }
    }
    std::vector<bool> turned(std::size_t(count), false);
    const auto turn_of = [&](Eigen::Index i) { return turned[std::size_t(i)] ? -1.0 : 1.0; };
    bool any = false;
    for (int round = 0; round < 4 * count; ++round) {
        double best = -k_least_gain;
        Eigen::Index first = -1, second = -1;
        for (Eigen::Index i = 0; i < count; ++i) {
            const double a = turn_of(i);
            const double alone = 2 * a * r(i) + a * a * big(i, i);
            if (alone < best) {
                best = alone;
                first = i;
                second = -1;
            }
            for (Eigen::Index k = 0; k < i; ++k) {
                const double b = turn_of(k);
                const double both =
                    alone + 2 * b * r(k) + b * b * big(k, k) + 2 * a * b * big(i, k);
                if (both < best) {
                    best = both;
                    first = i;
                    second = k;
                }
            }
        }
        if (first < 0) break;
        any = true;
        for (Eigen::Index i : {first, second}) {
            if (i < 0) continue;
            r += big.col(i) * turn_of(i);
            turned[std::size_t(i)] = !turned[std::size_t(i)];
        }
    }
    if (!any) return std::nullopt;
    Eigen::VectorXd right = Eigen::VectorXd::Zero(sheet.rows.count());
    for (Eigen::Index i = 0; i < count; ++i) {
        if (turned[std::size_t(i)]) right += shifts.col(i);
    }
    const auto s = solver.solve(none, right, k_precision);
    if (!s.good || s.unknowns.cwiseAbs().maxCoeff() > k_longest) return std::nullopt;
    return relaxation.freedoms().moved(
        shape, {s.unknowns.data(), static_cast<std::size_t>(s.unknowns.size())});
}

}  // namespace culet
