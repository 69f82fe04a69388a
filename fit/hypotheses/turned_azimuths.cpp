#include "fit/hypotheses/turned_azimuths.h"
#include "fit/hypotheses/constants.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "stone/numbers/units.h"

namespace culet {

namespace {

bool counts_from_zero(const Reading& r) {
    return r.kind == ReadingKind::azimuth && r.datum.kind != Datum::Kind::facet;
}

// Degrees by which azimuths are turned, in whole marks; 0 if they are not.
double marks_deg(const Attempt& first) {
    const double turned_deg = degrees(std::remainder(first.mesh_turn, 2 * std::numbers::pi));
    const double mark_deg = k_trials.mark_deg * std::round(turned_deg / k_trials.mark_deg);
    return std::abs(turned_deg - mark_deg) > k_trials.near_deg ? 0 : mark_deg;
}

}  // namespace

std::optional<Problem> azimuths_turned_back(const Problem& given, const Attempt& first) {
    const FitStatus status = first.result.status;
    if (!given.stone.azimuth_from_mesh || given.mirrored ||
        (status != FitStatus::contradictory && status != FitStatus::not_converged)) {
        return std::nullopt;
    }
    const double mark_deg = marks_deg(first);
    if (mark_deg == 0) return std::nullopt;
    Problem back = with_few_starts(given, first);
    for (Reading& r : back.readings) {
        if (counts_from_zero(r)) r.value -= radians(mark_deg);
    }
    return back;
}

Verdict judge_turned_azimuths(const Problem& given, const Attempt& first, const Problem&,
                              FitResult again) {
    if (again.status == FitStatus::not_converged ||
        !(again.statistics.chi2 < k_trials.chi2_left_turned * first.result.statistics.chi2)) {
        return {};
    }
    const double mark_deg = marks_deg(first);
    for (FittedReading& f : again.readings) {
        for (const Reading& r : given.readings) {
            if (r.id != f.id || !counts_from_zero(r)) continue;
            f.value = r.value;
            f.fitted += radians(mark_deg);
        }
    }
    const std::string why = fmt::format(
        "all azimuths read are {:g} degrees off the mesh, the widths are not: the fit subtracted "
        "{:g} degrees from each of them",
        std::abs(mark_deg), mark_deg);
    again.log.notes.insert(again.log.notes.begin(), why);
    again.message = again.status == FitStatus::converged ? why : why + "; " + again.message;
    again.status = FitStatus::contradictory;
    return {std::move(again), std::nullopt};
}

}  // namespace culet
