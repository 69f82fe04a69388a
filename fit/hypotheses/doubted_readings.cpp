#include "fit/hypotheses/doubted_readings.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "fit/findings/first_check.h"
#include "fit/uncertainty/statistics.h"

namespace culet {

namespace {

std::vector<Doubt> doubts_of(const Problem& given) {
    if (!given.options.first_check || given.read_in_full) return {};
    return first_check(given.stone, given.readings,
                       given.options.prior.source == Prior::Source::catalogue);
}

// Readings of one row count once, as they do beside a prior.
double rows_of(const Problem& given, const std::vector<Doubt>& doubts) {
    std::set<std::pair<std::string, long>> rows;
    for (const Doubt& d : doubts) {
        const Reading& r = given.readings[d.reading];
        rows.emplace(r.line > 0 ? r.file.string() : r.id, r.line);
    }
    return static_cast<double>(rows.size());
}

// Beside a prior whose size the readings tell, a slip makes the prior wider and is no longer missed
// by much: the two fits' chi-squares are of different sigmas. At the first fit's, chi-square falls
// by the square of Baarda's w when one reading is left out, and by no less with more of them.
double fall_at_first_sigmas(const Problem& given, const std::vector<Doubt>& doubts,
                            const FitResult& first) {
    double most = 0;
    for (const FittedReading& fitted : first.readings) {
        const bool is_doubted = std::any_of(doubts.begin(), doubts.end(), [&](const Doubt& d) {
            return given.readings[d.reading].id == fitted.id;
        });
        if (is_doubted && std::isfinite(fitted.normalized))
            most = std::max(most, fitted.normalized * fitted.normalized);
    }
    return most;
}

}  // namespace

std::optional<Problem> without_doubted(const Problem& given, const Attempt&) {
    std::vector<std::size_t> doubted;
    for (const Doubt& d : doubts_of(given)) doubted.push_back(d.reading);
    if (doubted.empty()) return std::nullopt;
    std::sort(doubted.begin(), doubted.end());
    Problem changed = given;
    changed.options.first_check = false;
    changed.readings = without(given.readings, doubted);
    return changed;
}

Verdict judge_doubted(const Problem& given, const Attempt& first, const Problem&, FitResult again) {
    if (again.status == FitStatus::not_converged) return {};
    const std::vector<Doubt> doubts = doubts_of(given);
    const double gain = std::max(first.result.statistics.chi2 - again.statistics.chi2,
                                 fall_at_first_sigmas(given, doubts, first.result));
    if (first.result.status != FitStatus::not_converged &&
        !(gain > chi2_quantile(given.options.significance, rows_of(given, doubts)))) {
        return {};
    }
    put_back_doubted(given.readings, doubts, again);
    return {std::move(again), std::nullopt};
}

}  // namespace culet
