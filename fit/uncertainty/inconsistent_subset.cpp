#include "fit/uncertainty/inconsistent_subset.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "fit/model/linear.h"
#include "fit/solve/free_meets.h"
#include "fit/uncertainty/constants.h"
#include "fit/uncertainty/statistics.h"
#include "stone/numbers/dense_algebra.h"

namespace culet {

namespace {

// A least-squares fit from which equations are left out one by one.
struct Rest {
    Eigen::VectorXd residuals;
    Eigen::MatrixXd matrix;
    double chi2 = 0, dof = 0;

    // The best checked first: rounding errors of the others stay small beside the earlier pivots.
    void leave_out(std::vector<Eigen::Index> equations) {
        while (!equations.empty()) {
            const auto next = std::max_element(
                equations.begin(), equations.end(),
                [this](Eigen::Index a, Eigen::Index b) { return matrix(a, a) < matrix(b, b); });
            leave_out_one(*next);
            equations.erase(next);
        }
    }
    // chi2 and dof without these; the other equations do not affect them.
    Rest sums_without(const std::vector<Eigen::Index>& equations) const {
        Rest part{residuals(equations), matrix(equations, equations), chi2, dof};
        std::vector<Eigen::Index> all(equations.size());
        std::iota(all.begin(), all.end(), 0);
        part.leave_out(std::move(all));
        return part;
    }

private:
    void leave_out_one(Eigen::Index i) {
        const double own = matrix(i, i);
        if (own > k_checks.no_redundancy) {
            const Eigen::VectorXd column = matrix.col(i) / own;
            chi2 -= residuals(i) * residuals(i) / own;
            residuals -= column * residuals(i);
            matrix.noalias() -= own * column * column.transpose();
            dof -= 1;
        }
        residuals(i) = 0;
        matrix.row(i).setZero();
        matrix.col(i).setZero();
    }
};

// Leaves out halves first, then single readings, while `spares` says that these can be spared,
// given the others.
template <class Spares>
void leave_out_what_can_be_spared(std::vector<int>& left, const Spares& spares) {
    for (std::size_t chunk = std::max<std::size_t>(1, left.size() / 2);;) {
        bool spared = false;
        for (std::size_t at = 0; at < left.size();) {
            const std::size_t end = std::min(left.size(), at + chunk);
            const auto first = left.begin() + std::ptrdiff_t(at),
                       last = left.begin() + std::ptrdiff_t(end);
            std::vector<int> others(left.begin(), first);
            others.insert(others.end(), last, left.end());
            if (spares(std::vector<int>(first, last), others)) {
                left = std::move(others);
                spared = true;
            } else {
                at = end;
            }
        }
        if (left.empty() || (chunk == 1 && !spared)) return;
        chunk = std::max<std::size_t>(1, std::min(chunk, left.size()) / 2);
    }
}

}  // namespace

std::vector<int> disagreeing_readings(const Eigen::VectorXd& residuals, Eigen::MatrixXd matrix,
                                      const std::vector<int>& owner, double level) {
    Rest rest{residuals, std::move(matrix), residuals.squaredNorm(), 0};
    rest.dof = rest.matrix.trace();
    const auto fails = [&](const Rest& r) {
        return r.dof > 0.5 && chi2_tail(std::max(0.0, r.chi2), r.dof) < level;
    };
    if (!fails(rest)) return {};
    std::map<int, std::vector<Eigen::Index>> equations;
    for (std::size_t i = 0; i < owner.size(); ++i) {
        if (owner[i] >= 0) equations[owner[i]].push_back(Eigen::Index(i));
    }
    // The least involved go first.
    std::vector<std::pair<double, int>> order;
    for (const auto& [reading, mine] : equations) {
        double part = 0;
        for (const Eigen::Index i : mine) {
            const double r = rest.matrix(i, i);
            if (r > k_checks.no_redundancy)
                part = std::max(part, std::abs(residuals(i)) / std::sqrt(r));
        }
        // Readings that only check one another differ by rounding errors alone.
        order.emplace_back(std::round(part / k_snooping.same_part), reading);
    }
    std::sort(order.begin(), order.end());
    std::vector<int> left;
    for (const auto& [part, reading] : order) left.push_back(reading);
    leave_out_what_can_be_spared(left, [&](const std::vector<int>& spared, const auto&) {
        std::vector<Eigen::Index> out;
        for (const int reading : spared) {
            const std::vector<Eigen::Index>& mine = equations[reading];
            out.insert(out.end(), mine.begin(), mine.end());
        }
        if (!fails(rest.sums_without(out))) return false;
        rest.leave_out(std::move(out));
        return true;
    });
    std::sort(left.begin(), left.end());
    return left;
}

std::vector<int> inconsistent_exact_readings(const FitModel& model, const Shape& shape,
                                             const std::shared_ptr<const Outline>& outline) {
    const Linearised linear = linearise(model, shape, outline);
    if (!(linear.worst_hard() > k_hard_limit)) return {};
    const Eigen::Index unknowns = linear.layout.size();
    // The least-squares shape cannot improve, so the equations that miss are those involved.
    std::set<int> readings;
    std::vector<std::size_t> meets;
    std::map<int, std::vector<std::size_t>> equations;
    for (std::size_t i = 0; i < linear.hard.size(); ++i) {
        const int reading = linear.hard[i].reading;
        if (reading < 0) {
            meets.push_back(i);
        } else {
            equations[reading].push_back(i);
            // Symmetry is built into the unknowns and never misses itself.
            if (is_relation(model.readings()[std::size_t(reading)].kind) ||
                std::abs(linear.hard_residuals(Eigen::Index(i))) > 1e-3 * linear.worst_hard()) {
                readings.insert(reading);
            }
        }
    }
    const auto fails = [&](const std::vector<int>& kept) {
        std::vector<std::size_t> used = meets;
        for (const int reading : kept) {
            used.insert(used.end(), equations[reading].begin(), equations[reading].end());
        }
        Eigen::MatrixXd columns(unknowns, Eigen::Index(used.size()));
        Eigen::VectorXd miss(Eigen::Index(used.size()));
        for (std::size_t k = 0; k < used.size(); ++k) {
            columns.col(Eigen::Index(k)) =
                Eigen::VectorXd(linear.hard_rows.row(Eigen::Index(used[k])).transpose());
            miss(Eigen::Index(k)) = linear.hard_residuals(Eigen::Index(used[k]));
        }
        // Misses in the range of A could be removed by a step; the part across it cannot.
        const PivotedQr qr(columns.transpose(), 1e-9);
        const Eigen::VectorXd across = qr.along(miss);
        if (qr.rank() == across.size()) return false;
        return across.tail(across.size() - qr.rank()).cwiseAbs().maxCoeff() >
               0.01 * linear.worst_hard() / std::sqrt(double(used.size()));
    };
    std::vector<int> left(readings.begin(), readings.end());
    if (left.empty() || meets.size() > 4000 || !fails(left)) {
        left.clear();
        for (const auto& [reading, mine] : equations) {
            for (const std::size_t i : mine) {
                if (std::abs(linear.hard_residuals(Eigen::Index(i))) > 1e-3 * linear.worst_hard()) {
                    left.push_back(reading);
                    break;
                }
            }
        }
        return left;
    }
    leave_out_what_can_be_spared(left, [&](const auto&, const std::vector<int>& others) {
        return !others.empty() && fails(others);
    });
    return left;
}

}  // namespace culet
