#include "fit/hypotheses/leave_one_out.h"

#include <algorithm>
#include <cmath>

#include "fit/findings/blunder.h"
#include "fit/hypotheses/constants.h"
#include "fit/uncertainty/statistics.h"

namespace culet {

namespace {

// Index of the first suspect, if it is a reading that may be wrong.
std::optional<std::size_t> first_suspect(const Problem& given, const FitResult& result) {
    if (result.findings.suspects.empty()) return std::nullopt;
    const auto wrong =
        std::find_if(given.readings.begin(), given.readings.end(),
                     [&](const Reading& r) { return r.id == result.findings.suspects.front(); });
    if (wrong == given.readings.end() || is_relation(wrong->kind) || wrong->exact) {
        return std::nullopt;
    }
    return std::size_t(wrong - given.readings.begin());
}

}  // namespace

std::optional<Problem> without_first_suspect(const Problem& given, const Attempt& first) {
    if (first.result.status != FitStatus::not_converged) return std::nullopt;
    const auto at = first_suspect(given, first.result);
    if (!at) return std::nullopt;
    Problem others = with_few_starts(given, first);
    Reading& wrong = others.readings[*at];
    wrong.sigma = k_trials.next_to_nothing * (std::abs(wrong.value) + wrong.sigma);
    wrong.rounding = 0;
    return others;
}

Verdict judge_first_suspect(const Problem& given, const Attempt& first, const Problem& changed,
                            FitResult again) {
    if (again.status == FitStatus::not_converged ||
        !(again.statistics.chi2 < k_trials.chi2_left_without * first.result.statistics.chi2)) {
        return {};
    }
    const std::size_t at = *first_suspect(given, first.result);
    const Reading& wrong = given.readings[at];
    const auto fitted = std::find_if(again.readings.begin(), again.readings.end(),
                                     [&](const FittedReading& r) { return r.id == wrong.id; });
    if (fitted == again.readings.end() || !fitted->left_out.empty()) return {};
    // A reading without weight shows the others' estimate; its variance is 1 - r of the reading's.
    const double sigma =
        changed.readings[at].sigma * std::sqrt(std::max(0.0, 1 - fitted->redundancy));
    if (!(std::abs(fitted->fitted - wrong.value) >
          again.statistics.suspect_limit * std::hypot(sigma, wrong.sigma))) {
        return {};
    }
    again.statistics.dof -= fitted->redundancy;
    again.statistics.chi2_p = chi2_tail(again.statistics.chi2, again.statistics.dof);
    again.statistics.chi2_limit =
        chi2_quantile(again.log.options.significance, again.statistics.dof);
    flag_blunder(wrong, fitted->fitted, sigma, again);
    return {std::move(again), std::nullopt};
}

}  // namespace culet
