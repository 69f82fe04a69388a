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
    return first_check(given.stone, given.readings,
                       given.options.prior.source == Prior::Source::catalogue);
}

std::vector<std::size_t> readings_of(const std::vector<Doubt>& doubts) {
    std::vector<std::size_t> doubted;
    for (const Doubt& d : doubts) doubted.push_back(d.reading);
    std::sort(doubted.begin(), doubted.end());
    return doubted;
}

bool is_among(const std::string& id, const std::vector<Reading>& readings) {
    return std::any_of(readings.begin(), readings.end(),
                       [&](const Reading& r) { return r.id == id; });
}

bool may_be_bent(const Problem& given, const FitResult& result, const std::vector<Doubt>& doubts) {
    if (!given.read_in_full || result.status == FitStatus::not_converged) return true;
    if (result.status != FitStatus::contradictory) return false;
    return result.findings.suspects.size() != 1 ||
           std::none_of(doubts.begin(), doubts.end(), [&](const Doubt& d) {
               return given.readings[d.reading].id == result.findings.suspects.front();
           });
}

bool is_plain_inclination(const Reading& r) {
    return r.kind == ReadingKind::inclination && r.facets.size() == 1 &&
           r.datum.kind == Datum::Kind::up;
}

// By how many sigmas a fit without this inclination contradicts it.
double denied_by(const Reading& r, const FitResult& without) {
    const FittedFacet& facet = without.facets[std::size_t(r.facets[0])];
    return std::abs(facet.inclination - r.value) / std::hypot(facet.sigma_inclination, r.sigma);
}

// Only inclinations can be tested; other readings count as denied.
bool is_denied(const Reading& r, const FitResult& without) {
    return !is_plain_inclination(r) || denied_by(r, without) > without.statistics.suspect_limit;
}

// Readings of one row count once, as they do with a prior.
double rows_of(const Problem& given, const std::vector<Doubt>& doubts) {
    std::set<std::pair<std::string, long>> rows;
    for (const Doubt& d : doubts) {
        const Reading& r = given.readings[d.reading];
        rows.emplace(r.line > 0 ? r.file.string() : r.id, r.line);
    }
    return static_cast<double>(rows.size());
}

// If the readings determine the prior's width, a slip widens it, and the two fits' chi-squares have
// different sigmas. With the first fit's, leaving out one reading lowers chi-square by the square
// of Baarda's w, and leaving out more by no less.
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

// A tier that is off as a whole widens the prior until nothing misses. With the second fit's
// sigmas, restoring one of its readings raises chi-square by the square of this, and restoring more
// by no less.
double rise_at_second_sigmas(const Problem& given, const std::vector<Doubt>& doubts,
                             const FitResult& again) {
    double most = 0;
    for (const Doubt& d : doubts) {
        const Reading& r = given.readings[d.reading];
        if (d.of_tier && is_plain_inclination(r))
            most = std::max(most, std::pow(denied_by(r, again), 2));
    }
    return most;
}

}  // namespace

std::optional<Problem> without_doubted(const Problem& given, const Attempt& first) {
    if (!given.options.first_check) return std::nullopt;
    const std::vector<Doubt> doubts = doubts_of(given);
    if (doubts.empty() || !may_be_bent(given, first.result, doubts)) return std::nullopt;
    Problem changed = given.read_in_full ? with_few_starts(given, first) : given;
    changed.options.first_check = false;
    changed.readings = without(given.readings, readings_of(doubts));
    return changed;
}

Verdict judge_doubted(const Problem& given, const Attempt& first, const Problem& changed,
                      FitResult again) {
    if (again.status == FitStatus::not_converged) return {};
    std::vector<Doubt> doubts = doubts_of(given);
    std::erase_if(doubts, [&](const Doubt& d) {
        return is_among(given.readings[d.reading].id, changed.readings);
    });
    const double level = given.options.significance;
    const double gain = std::max(first.result.statistics.chi2 - again.statistics.chi2,
                                 fall_at_first_sigmas(given, doubts, first.result));
    const bool pays = gain > chi2_quantile(level, rows_of(given, doubts)) ||
                      rise_at_second_sigmas(given, doubts, again) >
                          chi2_quantile(level / double(doubts.size()), 1);
    if (first.result.status != FitStatus::not_converged && !pays) return {};
    // With a rough mesh, good readings are doubted: restore those that the others do not
    // contradict.
    std::vector<Doubt> denied = doubts;
    if (given.read_in_full) {
        std::erase_if(denied,
                      [&](const Doubt& d) { return !is_denied(given.readings[d.reading], again); });
    }
    if (denied.empty()) return {};
    if (denied.size() < doubts.size()) {
        Problem next = changed;
        next.readings = without(given.readings, readings_of(denied));
        return {std::nullopt, std::move(next)};
    }
    restore_doubted(given.readings, doubts, again);
    return {std::move(again), std::nullopt};
}

}  // namespace culet
