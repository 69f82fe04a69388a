#include "fit/solve/sign_ambiguity.h"
#include "fit/solve/constants.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace culet {

namespace {

// Minimises 2 r't + t'B t, where t is 1 for turned facets and 0 for the others. Turns one or two at
// a time while that gains, then follows chains of turns (Kernighan & Lin 1970): each link is the
// best remaining turn, even if it costs. The part of the chain that gains most is kept.
class Turns {
public:
    Turns(Eigen::VectorXd r, const Eigen::MatrixXd& big)
        : big_(&big), r_(std::move(r)), turned_(std::size_t(r_.size()), 0) {}

    void gain_by_ones_and_twos() {
        // Bounded because rounding may make turns seem to gain for ever.
        Eigen::Index left = 4 * r_.size();
        while (left-- > 0 && gain_by_one_or_two()) continue;
    }
    bool gain_by_one_or_two() {
        double best = -k_signs.least_gain;
        Eigen::Index first = -1, second = -1;
        for (Eigen::Index i = 0; i < r_.size(); ++i) {
            const double one = alone(i);
            if (one < best) {
                best = one;
                first = i;
                second = -1;
            }
            for (Eigen::Index k = 0; k < i; ++k) {
                const double both = one + alone(k) + 2 * way(i) * way(k) * (*big_)(i, k);
                if (both < best) {
                    best = both;
                    first = i;
                    second = k;
                }
            }
        }
        if (first < 0) return false;
        turn(first);
        if (second >= 0) turn(second);
        return true;
    }

    /// The results of chains that begin at each facet, each improved by ones and twos.
    std::vector<Turns> ends_of_chains() const {
        std::vector<Eigen::Index> begins;
        for (Eigen::Index i = 0; i < r_.size(); ++i) begins.push_back(i);
        if (begins.size() > k_signs.most_begins) {
            std::stable_sort(begins.begin(), begins.end(), [this](Eigen::Index a, Eigen::Index b) {
                return alone(a) < alone(b);
            });
            begins.resize(k_signs.most_begins);
        }
        std::vector<Turns> ends;
        for (const Eigen::Index begin : begins) {
            Turns chain = *this, best = *this;
            std::vector<char> is_taken(turned_.size(), 0);
            Eigen::Index next = begin;
            for (std::size_t length = 0; length < turned_.size(); ++length) {
                if (length > 0) next = chain.cheapest(is_taken);
                chain.turn(next);
                is_taken[std::size_t(next)] = 1;
                if (length == 0 || chain.change_ < best.change_) best = chain;
            }
            best.gain_by_ones_and_twos();
            ends.push_back(std::move(best));
        }
        return ends;
    }

    double change() const { return change_; }
    const std::vector<char>& turned() const { return turned_; }

private:
    // Direction of the next turn of a facet: over (1) or back (-1).
    double way(Eigen::Index i) const { return turned_[std::size_t(i)] ? -1.0 : 1.0; }
    double alone(Eigen::Index i) const { return 2 * way(i) * r_(i) + (*big_)(i, i); }
    Eigen::Index cheapest(const std::vector<char>& is_taken) const {
        Eigen::Index best = -1;
        for (Eigen::Index i = 0; i < r_.size(); ++i) {
            if (!is_taken[std::size_t(i)] && (best < 0 || alone(i) < alone(best))) best = i;
        }
        return best;
    }
    void turn(Eigen::Index i) {
        change_ += alone(i);
        r_ += big_->col(i) * way(i);
        turned_[std::size_t(i)] ^= 1;
    }

    const Eigen::MatrixXd* big_;
    Eigen::VectorXd r_;
    std::vector<char> turned_;
    double change_ = 0;
};

// The best few, the best first; only those that gain.
std::vector<std::vector<char>> best_turns(Eigen::VectorXd r, const Eigen::MatrixXd& big,
                                          std::size_t most) {
    Turns near(std::move(r), big);
    near.gain_by_ones_and_twos();
    std::vector<Turns> ends = near.ends_of_chains();
    ends.push_back(std::move(near));
    std::stable_sort(ends.begin(), ends.end(),
                     [](const Turns& a, const Turns& b) { return a.change() < b.change(); });
    std::vector<std::vector<char>> best;
    for (const Turns& end : ends) {
        if (!(end.change() < -k_signs.least_gain) || best.size() == most) break;
        if (std::find(best.begin(), best.end(), end.turned()) == best.end())
            best.push_back(end.turned());
    }
    return best;
}

// Returns what to add to the values of a linearisation's rows when facets take the other sign, for
// the `most` best sets of facets that gain, the best first. `pulls`: the rows' residuals over their
// variances at the optimum of the factored equations.
std::vector<Eigen::VectorXd> better_sign_choices(
    const std::vector<Relaxation::SignAmbiguity>& ambiguous, const KktSolver& solver,
    const Eigen::VectorXd& pulls, std::size_t most) {
    const auto count = static_cast<Eigen::Index>(ambiguous.size());
    // A residual falls by the shift of its value. Turning facet i changes chi-square by 2 r(i), the
    // linear part, and big(i, i), the quadratic one.
    Eigen::VectorXd r = Eigen::VectorXd::Zero(count);
    Eigen::MatrixXd shifts = Eigen::MatrixXd::Zero(pulls.size(), count);
    for (Eigen::Index i = 0; i < count; ++i) {
        for (const auto& [row, shift] : ambiguous[std::size_t(i)].turns) {
            r(i) -= shift * pulls(row);
            shifts(row, i) = shift;
        }
    }
    const auto solved = solver.solve_all(Eigen::MatrixXd(), shifts, k_signs.precision);
    if (!solved.good) return {};
    Eigen::MatrixXd big = Eigen::MatrixXd::Zero(count, count);
    for (Eigen::Index k = 0; k < count; ++k) {
        for (const auto& [row, shift] : ambiguous[std::size_t(k)].turns) {
            // multipliers = (J x - b) / variance
            big.row(k) -= shift * solved.multipliers.row(row);
        }
    }
    // Symmetrise: solution errors would make turns there and back seem to gain.
    big = (0.5 * (big + big.transpose())).eval();
    std::vector<Eigen::VectorXd> choices_of_sign;
    for (const std::vector<char>& turned : best_turns(std::move(r), big, most)) {
        choices_of_sign.push_back(Eigen::VectorXd::Zero(pulls.size()));
        for (Eigen::Index i = 0; i < count; ++i) {
            if (turned[std::size_t(i)]) choices_of_sign.back() += shifts.col(i);
        }
    }
    return choices_of_sign;
}

}  // namespace

std::vector<Shape> better_signs(Relaxation& relaxation, KktSolver& solver, const Shape& shape,
                                const PenaltyScale& penalty, double within, std::size_t most,
                                const std::vector<int>& sides) {
    relaxation.select_branches(shape, penalty.incidence == 0);
    std::vector<Relaxation::SignAmbiguity> ambiguous = relaxation.ambiguous(shape, within);
    std::erase_if(ambiguous, [&](const Relaxation::SignAmbiguity& f) {
        return !sides.empty() && sides[std::size_t(f.facet)] != 0;
    });
    if (ambiguous.empty()) return {};
    const StepLinearisation linearisation = relaxation.linearisation(shape, penalty);
    if (!solver.factor(linearisation.rows,
                       linearisation.prior_stiffness + k_signs.damping * relaxation.metric()))
        return {};
    Eigen::VectorXd pulls = linearisation.rows.residuals();
    for (Eigen::Index i = 0; i < pulls.size(); ++i) {
        const double variance = linearisation.rows.variance[std::size_t(i)];
        pulls(i) = variance > 0 ? pulls(i) / variance : 0;
    }
    const Eigen::VectorXd none = Eigen::VectorXd::Zero(relaxation.parameters().size());
    std::vector<Shape> others;
    for (const Eigen::VectorXd& right : better_sign_choices(ambiguous, solver, pulls, most)) {
        const auto s = solver.solve(none, right, k_signs.precision);
        if (!s.good || s.unknowns.cwiseAbs().maxCoeff() > k_signs.farthest) continue;
        others.push_back(relaxation.parameters().retracted_with_turn(
            shape, {s.unknowns.data(), static_cast<std::size_t>(s.unknowns.size())}));
    }
    return others;
}

}  // namespace culet
