#include "fit/uncertainty/snooping.h"
#include "fit/uncertainty/constants.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "stone/numbers/dense_algebra.h"

namespace culet {

namespace {

using Index = Eigen::Index;

class Search {
public:
    explicit Search(const Residuals& residuals) : given_(residuals) {}

    const Eigen::VectorXd& column(Index i) {
        const auto found = columns_.find(i);
        if (found != columns_.end()) return found->second;
        return columns_.emplace(i, given_.column(i)).first->second;
    }

    // Residuals and redundancies when the set is left out.
    struct State {
        std::vector<Index> set;
        Eigen::VectorXd values, redundancy, errors;
        Eigen::MatrixXd columns, inverse;  ///< of R; inverse of R's block of the set
        double gain = 0;                   // of chi2
        bool possible = true;
    };
    State without(const std::vector<Index>& set) {
        State state{set, given_.values, given_.redundancy, {}, {}, {}, 0, true};
        const Index count = Index(set.size());
        if (count == 0) return state;
        state.columns.resize(given_.values.size(), count);
        for (Index a = 0; a < count; ++a) state.columns.col(a) = column(set[std::size_t(a)]);
        const Eigen::VectorXd values = given_.values(set);
        const SymmetricEigen eigen = symmetric_eigen(state.columns(set, Eigen::all));
        if (!(eigen.values(0) > 0.1 * k_snooping.least_tested)) {
            state.possible = false;  // together they leave nothing that checks them
            return state;
        }
        state.inverse = times_transpose(eigen.vectors * eigen.values.cwiseInverse().asDiagonal(),
                                        eigen.vectors);
        state.errors = state.inverse * values;
        state.gain = values.dot(state.errors);
        state.values -= state.columns * state.errors;
        state.redundancy -=
            product(state.columns, state.inverse).cwiseProduct(state.columns).rowwise().sum();
        for (const Index i : set) state.values(i) = state.redundancy(i) = 0;
        return state;
    }

    // The column of R when the state's set is left out.
    Eigen::VectorXd column_without(const State& state, Index i) {
        Eigen::VectorXd result = column(i);
        if (!state.set.empty()) {
            result -= state.columns * (state.inverse * result(state.set)).eval();
        }
        return result;
    }

    static double gain_of(const State& state, Index i) {
        return state.redundancy(i) > k_snooping.least_tested
                   ? state.values(i) * state.values(i) / state.redundancy(i)
                   : 0;
    }

    static Index best_single(const State& state) {
        Index best = -1;
        double most = 0;
        for (Index i = 0; i < state.values.size(); ++i) {
            if (gain_of(state, i) > most) {
                most = gain_of(state, i);
                best = i;
            }
        }
        return best;
    }

    struct Pair {
        Index first = -1, second = -1;
        double gain = 0;
    };
    Pair best_pair(const State& state) {
        std::vector<Index> order;
        for (Index i = 0; i < state.values.size(); ++i) {
            if (state.redundancy(i) > k_snooping.least_tested) order.push_back(i);
        }
        const std::size_t count = std::min(order.size(), k_snooping.pair_candidates);
        std::partial_sort(order.begin(), order.begin() + std::ptrdiff_t(count), order.end(),
                          [&](Index a, Index b) {
                              const double ga = gain_of(state, a), gb = gain_of(state, b);
                              return ga > gb || (ga == gb && a < b);
                          });
        Pair best;
        for (std::size_t c = 0; c < count; ++c) {
            const Index i = order[c];
            const double alone = gain_of(state, i);
            const Eigen::VectorXd link = column_without(state, i) / state.redundancy(i);
            for (Index j = 0; j < state.values.size(); ++j) {
                if (j == i) continue;
                const double left = state.redundancy(j) - link(j) * link(j) * state.redundancy(i);
                if (!(left > k_snooping.least_tested)) continue;
                const double value = state.values(j) - link(j) * state.values(i);
                const double gain = alone + value * value / left;
                if (gain > best.gain) best = {i, j, gain};
            }
        }
        return best;
    }

private:
    const Residuals& given_;
    std::map<Index, Eigen::VectorXd> columns_;
};

std::vector<Index> with(std::vector<Index> set, Index i) {
    set.push_back(i);
    return set;
}

std::vector<Index> less(std::vector<Index> set, std::size_t at) {
    set.erase(set.begin() + std::ptrdiff_t(at));
    return set;
}

}  // namespace

std::vector<Outlier> find_outliers(const Residuals& residuals, double limit, double pair_limit,
                                   std::size_t most) {
    Search search(residuals);
    Search::State state = search.without({});
    const double enough = limit * limit;
    for (int round = 0; round < 50 && state.set.size() < most; ++round) {
        const Index single = Search::best_single(state);
        const double gain = single < 0 ? 0 : Search::gain_of(state, single);
        Search::State next = state;
        const Search::Pair pair = search.best_pair(state);
        const bool pair_counts = pair.gain > pair_limit && pair.gain > gain + enough;
        if (pair_counts) next = search.without(with(with(state.set, pair.first), pair.second));
        if (!pair_counts || !next.possible) {
            if (!(gain > enough)) break;
            next = search.without(with(state.set, single));
        }
        if (!next.possible) break;
        // Drops what the new ones made needless, and exchanges what others explain better.
        for (int again = 0; again < 8; ++again) {
            bool changed = false;
            for (std::size_t a = 0; a < next.set.size() && !changed; ++a) {
                Search::State fewer = search.without(less(next.set, a));
                if (!fewer.possible) continue;
                const Index other = Search::best_single(fewer);
                const double with_other =
                    fewer.gain + (other < 0 ? 0 : Search::gain_of(fewer, other));
                if (next.set.size() > 1 && next.gain - fewer.gain < enough) {
                    next = std::move(fewer);
                    changed = true;
                } else if (other != next.set[a] && with_other > next.gain + 1e-6 * next.gain) {
                    Search::State swapped = search.without(with(fewer.set, other));
                    if (!swapped.possible) continue;
                    next = std::move(swapped);
                    changed = true;
                }
            }
            if (!changed) break;
        }
        if (!(next.gain > state.gain)) break;
        state = std::move(next);
        if (state.set.size() < k_snooping.few) continue;
        Index standing_out = 0;
        for (Index i = 0; i < state.values.size(); ++i)
            standing_out += Search::gain_of(state, i) > enough ? 1 : 0;
        if (standing_out > state.values.size() / 10 || state.set.size() >= k_snooping.many) break;
    }

    std::vector<Outlier> outliers;
    for (std::size_t a = 0; a < state.set.size(); ++a) {
        Outlier outlier;
        outlier.equation = state.set[a];
        // residual = R error, and residuals are fitted - read: an error in the reading has the
        // opposite sign.
        outlier.error = -state.errors(Index(a));
        outlier.error_sigma = std::sqrt(state.inverse(Index(a), Index(a)));
        const Search::State fewer = search.without(less(state.set, a));
        for (Index j = 0; j < residuals.values.size() && fewer.possible; ++j) {
            if (j == outlier.equation) continue;
            if (std::find(state.set.begin(), state.set.end(), j) != state.set.end()) continue;
            if (fewer.gain + Search::gain_of(fewer, j) > state.gain - k_snooping.alternative) {
                outlier.alternatives.push_back(j);
            }
        }
        outlier.gain = state.gain - fewer.gain;
        outliers.push_back(std::move(outlier));
    }
    std::stable_sort(outliers.begin(), outliers.end(),
                     [](const Outlier& a, const Outlier& b) { return a.gain > b.gain; });
    return outliers;
}

}  // namespace culet
