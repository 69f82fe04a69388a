#include "fit/findings/verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace culet {

namespace {

// A doubted row may hold several readings, all of them suspects.
std::size_t doubted_more(const FitResult& result) {
    const auto left_out =
        std::count_if(result.readings.begin(), result.readings.end(),
                      [](const FittedReading& r) { return r.suspect && !r.left_out.empty(); });
    return std::size_t(
        std::max<std::ptrdiff_t>(0, left_out - std::ptrdiff_t(result.findings.doubts.size())));
}

// Of the fit with what the first check doubts, and without.
std::string both_figures(const FitResult& result, bool one) {
    const auto change = std::find_if(result.log.changed.begin(), result.log.changed.end(),
                                     [](const Change& c) { return c.what == k_readings_left_out; });
    if (change == result.log.changed.end()) return {};
    return fmt::format(" (chi-square {:.1f} with {}, {:.1f} without)", change->before,
                       one ? "it" : "them", change->after);
}

// What chi-square says, in the readings' own measure.
std::string misfit_words(const FitStatistics& statistics) {
    return fmt::format(
        "{:.2f} times as far off as their sigmas say (chi-square {:.1f}; {:.1f} expected, up to "
        "{:.1f} by chance)",
        std::sqrt(statistics.chi2 / statistics.dof), statistics.chi2, statistics.dof,
        statistics.chi2_limit);
}

}  // namespace

std::string fit_verdict(const FitResult& result) {
    switch (result.status) {
        case FitStatus::converged:
            return result.statistics.dof > 0
                       ? fmt::format("The readings agree with this stone: they are {}.",
                                     misfit_words(result.statistics))
                       : "This stone has these readings: there are no more than it needs, so that "
                         "none checks another.";
        case FitStatus::contradictory:
            if (!result.findings.doubts.empty()) {
                const bool agrees = result.statistics.dof <= 0 ||
                                    result.statistics.chi2 <= result.statistics.chi2_limit;
                const bool one = result.findings.doubts.size() == 1;
                return fmt::format(
                    "{} left out{}; {}.", one ? "It is" : "They are", both_figures(result, one),
                    agrees && result.findings.suspects.size() <=
                                  result.findings.doubts.size() + doubted_more(result)
                        ? "the other readings agree with this stone"
                        : "even so the others do not agree");
            }
            if (result.statistics.dof > 0 &&
                result.statistics.chi2 > result.statistics.chi2_limit) {
                return fmt::format("The readings contradict each other: they are {}.",
                                   misfit_words(result.statistics));
            }
            return fmt::format("The readings contradict each other: {}.", result.message);
        case FitStatus::undetermined:
            return fmt::format("The readings do not suffice: {}.", result.message);
        case FitStatus::not_converged:
            break;
    }
    return fmt::format("Do not rely on this stone: {}.", result.message);
}

}  // namespace culet
