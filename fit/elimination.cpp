#include "fit/elimination.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace culet {

namespace {

using Entries = std::vector<std::pair<int, double>>;

// What is left of an equation after substitution, relative to what went into it, when it only
// repeats others.
constexpr double k_repeats = 1e-10;
// A preferred column is taken when its entry is at least this part of the largest.
constexpr double k_preferred = 0.1;
// Entries this much smaller than the largest of their sum are what cancellation leaves.
constexpr double k_cancelled = 1e-15;

class Elimination {
public:
    explicit Elimination(int unknowns)
        : expressions_(std::size_t(unknowns)),
          uses_(std::size_t(unknowns)),
          eliminated_(std::size_t(unknowns), false),
          sum_(std::size_t(unknowns), 0),
          size_(std::size_t(unknowns), 0) {}

    // True when the equation took one more unknown.
    bool add(const Entries& equation, int first_preferred, int end_preferred) {
        const Entries row = substituted(equation);
        double largest = 0;
        for (const auto& [column, value] : row) largest = std::max(largest, std::abs(value));
        if (!(largest > k_repeats * most_)) return false;
        int pivot = -1;
        double best = 0;
        for (const auto& [column, value] : row) {
            const bool preferred = column >= first_preferred && column < end_preferred;
            const double rank =
                std::abs(value) +
                (preferred && std::abs(value) > k_preferred * largest ? 2 * largest : 0);
            if (rank > best) {
                best = rank;
                pivot = column;
            }
        }
        double at_pivot = 0;
        for (const auto& [column, value] : row) {
            if (column == pivot) at_pivot = value;
        }
        Entries expression;
        for (const auto& [column, value] : row) {
            if (column != pivot) expression.emplace_back(column, -value / at_pivot);
        }
        // Earlier expressions that used the pivot use its expression instead.
        for (const int user : std::exchange(uses_[std::size_t(pivot)], {})) {
            Entries& old = expressions_[std::size_t(user)];
            const auto there = std::find_if(
                old.begin(), old.end(), [&](const auto& entry) { return entry.first == pivot; });
            if (there == old.end()) continue;
            const double factor = there->second;
            old.erase(there);
            begin_sum();
            for (const auto& [column, value] : old) accumulate(column, value);
            const std::size_t own = touched_.size();
            for (const auto& [column, value] : expression) accumulate(column, factor * value);
            for (std::size_t i = own; i < touched_.size(); ++i) {
                uses_[std::size_t(touched_[i])].push_back(user);
            }
            old = end_sum();
        }
        for (const auto& [column, value] : expression) uses_[std::size_t(column)].push_back(pivot);
        expressions_[std::size_t(pivot)] = std::move(expression);
        eliminated_[std::size_t(pivot)] = true;
        return true;
    }

    FreeDirections result() const {
        FreeDirections free;
        const int unknowns = int(expressions_.size());
        std::vector<int> place(expressions_.size(), -1);
        int count = 0;
        for (int i = 0; i < unknowns; ++i) {
            if (!eliminated_[std::size_t(i)]) place[std::size_t(i)] = count++;
        }
        std::vector<Eigen::Triplet<double>> entries;
        for (int i = 0; i < unknowns; ++i) {
            if (!eliminated_[std::size_t(i)]) {
                entries.emplace_back(i, place[std::size_t(i)], 1.0);
                continue;
            }
            for (const auto& [column, value] : expressions_[std::size_t(i)]) {
                entries.emplace_back(i, place[std::size_t(column)], value);
                free.growth = std::max(free.growth, std::abs(value));
            }
        }
        free.basis.resize(unknowns, count);
        free.basis.setFromTriplets(entries.begin(), entries.end());
        free.rank = unknowns - count;
        return free;
    }

private:
    void begin_sum() { touched_.clear(); }
    void accumulate(int column, double value) {
        const std::size_t c = std::size_t(column);
        if (size_[c] == 0 && value != 0) touched_.push_back(column);
        sum_[c] += value;
        size_[c] += std::abs(value);
    }
    Entries end_sum() {
        Entries entries;
        for (const int column : touched_) {
            const std::size_t c = std::size_t(column);
            if (std::abs(sum_[c]) > k_cancelled * size_[c]) entries.emplace_back(column, sum_[c]);
            sum_[c] = size_[c] = 0;
        }
        return entries;
    }
    Entries substituted(const Entries& equation) {
        begin_sum();
        most_ = 0;
        for (const auto& [column, value] : equation) {
            if (!eliminated_[std::size_t(column)]) {
                accumulate(column, value);
                most_ = std::max(most_, std::abs(value));
                continue;
            }
            for (const auto& [other, factor] : expressions_[std::size_t(column)]) {
                accumulate(other, value * factor);
                most_ = std::max(most_, std::abs(value * factor));
            }
            most_ = std::max(most_, std::abs(value));
        }
        return end_sum();
    }

    std::vector<Entries> expressions_;    // of eliminated unknowns, in those that are not
    std::vector<std::vector<int>> uses_;  // which expressions may use an unknown
    std::vector<bool> eliminated_;
    std::vector<double> sum_, size_;
    std::vector<int> touched_;
    double most_ = 0;  // the largest term of the latest substitution
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
