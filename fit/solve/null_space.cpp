#include "fit/solve/null_space.h"
#include "fit/solve/constants.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

namespace culet {

namespace {

using Entries = std::vector<std::pair<int, double>>;

// Forward elimination. An expression holds unknowns that remained when it was made; those
// eliminated later are substituted once, at the end, from the last expression to the first.
class Elimination {
public:
    explicit Elimination(int unknowns)
        : expressions_(std::size_t(unknowns)),
          step_(std::size_t(unknowns), -1),
          doubts_(std::size_t(unknowns), 0),
          sum_(std::size_t(unknowns), 0),
          size_(std::size_t(unknowns), 0) {}

    // Returns true when the equation eliminated one more unknown.
    bool add(const Entries& equation, int first_preferred, int end_preferred) {
        substitute(equation);
        double largest = 0;
        for (const auto& [column, value] : row_) largest = std::max(largest, std::abs(value));
        if (!(largest > k_null_space.repeats * most_ && largest > k_null_space.rounding * doubt_))
            return false;
        int pivot = -1;
        double best = 0, at_pivot = 0;
        for (const auto& [column, value] : row_) {
            const bool preferred = column >= first_preferred && column < end_preferred;
            const double rank =
                std::abs(value) +
                (preferred && std::abs(value) > k_null_space.preferred * largest ? 2 * largest : 0);
            if (rank > best) {
                best = rank;
                pivot = column;
                at_pivot = value;
            }
        }
        Entries& expression = expressions_[std::size_t(pivot)];
        expression.reserve(row_.size() - 1);
        for (const auto& [column, value] : row_) {
            if (column != pivot) expression.emplace_back(column, -value / at_pivot);
        }
        doubts_[std::size_t(pivot)] = doubt_ / std::abs(at_pivot);
        step_[std::size_t(pivot)] = static_cast<int>(order_.size());
        order_.push_back(pivot);
        return true;
    }

    FreeDirections result() const {
        std::vector<int> place(expressions_.size(), -1);
        int count = 0;
        for (std::size_t i = 0; i < place.size(); ++i) {
            if (step_[i] < 0) place[i] = count++;
        }
        FreeDirections basis = FreeDirections::Zero(Eigen::Index(place.size()), count);
        for (std::size_t i = 0; i < place.size(); ++i) {
            if (place[i] >= 0) basis(Eigen::Index(i), place[i]) = 1;
        }
        for (auto pivot = order_.rbegin(); pivot != order_.rend(); ++pivot) {
            for (const auto& [column, value] : expressions_[std::size_t(*pivot)]) {
                if (place[std::size_t(column)] >= 0) {
                    basis(*pivot, place[std::size_t(column)]) += value;
                } else {
                    basis.row(*pivot) += value * basis.row(column);
                }
            }
        }
        return basis;
    }

private:
    // Returns true when the column was not yet in the sum.
    bool accumulate(int column, double value) {
        const std::size_t c = std::size_t(column);
        const bool is_new = size_[c] == 0 && value != 0;
        if (is_new) touched_.push_back(column);
        sum_[c] += value;
        size_[c] += std::abs(value);
        return is_new;
    }
    // Removes an unknown from the sum and returns its coefficient (0 if cancelled).
    double taken(int column) {
        const std::size_t c = std::size_t(column);
        const double value = std::abs(sum_[c]) > k_null_space.cancelled * size_[c] ? sum_[c] : 0;
        sum_[c] = size_[c] = 0;
        return value;
    }
    void take_sum(Entries& to) {
        for (const int column : touched_) {
            if (const double value = taken(column); value != 0) to.emplace_back(column, value);
        }
        touched_.clear();
    }
    // Puts the equation, in the remaining unknowns, into `row_`.
    void substitute(const Entries& equation) {
        most_ = doubt_ = 0;
        waiting_.clear();
        const auto put = [&](int column, double value) {
            most_ = std::max(most_, std::abs(value));
            const int step = step_[std::size_t(column)];
            if (!accumulate(column, value) || step < 0) return;
            waiting_.push_back(step);
            std::push_heap(waiting_.begin(), waiting_.end(), std::greater<>());
        };
        for (const auto& [column, value] : equation) put(column, value);
        // Earliest first: its expression holds only unknowns eliminated later.
        while (!waiting_.empty()) {
            std::pop_heap(waiting_.begin(), waiting_.end(), std::greater<>());
            const int column = order_[std::size_t(waiting_.back())];
            waiting_.pop_back();
            const double value = taken(column);
            if (value == 0) continue;
            doubt_ = std::max(doubt_, std::abs(value) * doubts_[std::size_t(column)]);
            for (const auto& [other, factor] : expressions_[std::size_t(column)]) {
                put(other, value * factor);
            }
        }
        doubt_ = std::max(doubt_, most_);
        row_.clear();
        take_sum(row_);
    }

    std::vector<Entries> expressions_;  // of eliminated unknowns, in later ones
    std::vector<int> step_;             // at which each was eliminated; -1: it remains
    std::vector<double> doubts_;        // rounding scale of each expression, see `doubt_`
    std::vector<int> order_;            // of elimination
    std::vector<double> sum_, size_;
    std::vector<int> touched_, waiting_;
    Entries row_;
    double most_ = 0;  // largest term of the latest substitution
    // Scale of its rounding error (running error analysis, Higham 2002, 3.3): the largest term, or
    // an expression's scale times its factor, divided by the pivot.
    double doubt_ = 0;
};

}  // namespace

FreeDirections free_directions(const Eigen::SparseMatrix<double, Eigen::RowMajor>& rows,
                               Eigen::Index first_preferred, Eigen::Index end_preferred) {
    Elimination elimination(int(rows.cols()));
    // Short equations first: their expressions are short.
    std::vector<std::pair<Eigen::Index, Eigen::Index>> order;
    for (Eigen::Index i = 0; i < rows.rows(); ++i) {
        order.emplace_back(rows.innerVector(i).nonZeros(), i);
    }
    std::stable_sort(order.begin(), order.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    for (const auto& [length, i] : order) {
        Entries entries;
        double squares = 0;
        for (Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator it(rows, i); it; ++it) {
            if (it.value() == 0) continue;
            entries.emplace_back(int(it.col()), it.value());
            squares += it.value() * it.value();
        }
        if (!(squares > 0)) continue;
        for (auto& [column, value] : entries) value /= std::sqrt(squares);
        elimination.add(entries, int(first_preferred), int(end_preferred));
    }
    return elimination.result();
}

}  // namespace culet
