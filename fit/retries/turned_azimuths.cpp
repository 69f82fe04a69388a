#include "fit/retries/turned_azimuths.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "stone/units.h"

namespace culet {

namespace {

// Who reads from the wrong mark is off by a mark; what the mesh's own errors turn it by is less.
constexpr double k_mark_deg = 15, k_near_deg = 4;
// What explains a contradiction takes most of chi-square with it.
constexpr double k_part_left = 0.5;

bool counts_from_zero(const Reading& r) {
    return r.kind == ReadingKind::azimuth && r.datum.kind != Datum::Kind::facet;
}

}  // namespace

std::optional<FitResult> fit_turning_azimuths_back(
    const FitResult& result, const std::vector<Reading>& readings, double turn,
    const std::function<FitResult(const std::vector<Reading>&)>& fit_again) {
    if (result.status != FitStatus::contradictory && result.status != FitStatus::not_converged) {
        return std::nullopt;
    }
    const double turned_deg = degrees(std::remainder(turn, 2 * std::numbers::pi));
    const double mark_deg = k_mark_deg * std::round(turned_deg / k_mark_deg);
    if (mark_deg == 0 || std::abs(turned_deg - mark_deg) > k_near_deg) return std::nullopt;
    std::vector<Reading> back = readings;
    for (Reading& r : back) {
        if (counts_from_zero(r)) r.value -= radians(mark_deg);
    }
    FitResult better = fit_again(back);
    if (better.status == FitStatus::not_converged || !(better.chi2 < k_part_left * result.chi2)) {
        return std::nullopt;
    }
    for (FittedReading& f : better.readings) {
        for (const Reading& r : readings) {
            if (r.id != f.id || !counts_from_zero(r)) continue;
            f.value = r.value;
            f.fitted += radians(mark_deg);
        }
    }
    const std::string why = fmt::format(
        "all azimuths read count from {:g} degrees beside the mesh, and the widths do not: the fit "
        "took {:g} degrees off each of them",
        std::abs(mark_deg), mark_deg);
    better.notes.insert(better.notes.begin(), why);
    better.message = better.status == FitStatus::converged ? why : why + "; " + better.message;
    better.status = FitStatus::contradictory;
    return better;
}

}  // namespace culet
