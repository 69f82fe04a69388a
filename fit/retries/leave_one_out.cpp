#include "fit/retries/leave_one_out.h"

#include <algorithm>
#include <cmath>

#include "fit/findings/blunder.h"
#include "fit/uncertainty/statistics.h"

namespace culet {

namespace {

// Of the value itself: what is so uncertain pulls at nothing.
constexpr double k_next_to_nothing = 1e3;
// What explains why there is no stone takes nearly all of chi-square with it.
constexpr double k_part_left = 0.01;

}  // namespace

std::optional<FitResult> fit_leaving_one_out(
    const FitResult& result, const std::vector<Reading>& readings,
    const std::function<FitResult(const std::vector<Reading>&)>& fit_again) {
    if (result.status != FitStatus::not_converged || result.suspects.empty()) return std::nullopt;
    const auto has_id = [&](const auto& r) { return r.id == result.suspects.front(); };
    const auto wrong = std::find_if(readings.begin(), readings.end(), has_id);
    if (wrong == readings.end() || is_relation(wrong->kind) || wrong->exact) return std::nullopt;
    const auto at = std::size_t(wrong - readings.begin());
    std::vector<Reading> others = readings;
    others[at].sigma = k_next_to_nothing * (std::abs(wrong->value) + wrong->sigma);
    others[at].rounding = 0;
    FitResult without = fit_again(others);
    if (without.status == FitStatus::not_converged || !(without.chi2 < k_part_left * result.chi2)) {
        return std::nullopt;
    }
    const auto fitted = std::find_if(without.readings.begin(), without.readings.end(), has_id);
    if (fitted == without.readings.end() || !fitted->left_out.empty()) return std::nullopt;
    // What is asked for nothing has the others' estimate: its variance over its own is 1 - r.
    const double sigma = others[at].sigma * std::sqrt(std::max(0.0, 1 - fitted->redundancy));
    if (!(std::abs(fitted->fitted - wrong->value) >
          without.suspect_limit * std::hypot(sigma, wrong->sigma))) {
        return std::nullopt;
    }
    without.dof -= fitted->redundancy;
    without.chi2_p = chi2_tail(without.chi2, without.dof);
    without.chi2_limit = chi2_quantile(without.options.significance, without.dof);
    flag_blunders(readings, {{at, fitted->fitted, sigma}}, without);
    return without;
}

}  // namespace culet
