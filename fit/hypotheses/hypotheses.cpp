#include "fit/hypotheses/hypotheses.h"

#include <algorithm>

#include "fit/hypotheses/constants.h"
#include "fit/hypotheses/doubted_readings.h"
#include "fit/hypotheses/leave_one_out.h"
#include "fit/hypotheses/mirrored_mesh.h"
#include "fit/hypotheses/turned_azimuths.h"

namespace culet {

namespace {

// By their number the readings determine the stone, but this fit shows that they do not.
std::optional<Problem> with_prior(const Problem& given, const Attempt& first) {
    const FitStatus status = first.result.status;
    if (!given.read_in_full || given.options.prior.source == Prior::Source::none ||
        given.options.prior.always ||
        (status != FitStatus::undetermined && status != FitStatus::not_converged)) {
        return std::nullopt;
    }
    Problem changed = given;
    changed.read_in_full = false;
    return changed;
}

Verdict take_with_prior(const Problem&, const Attempt&, const Problem&, FitResult again) {
    return {std::move(again), std::nullopt};
}

constexpr Hypothesis k_hypotheses[] = {
    // The mesh is the mirror image of the stone. First, because it makes many readings look wrong.
    {"mesh mirrored", mesh_mirrored, judge_mirrored_mesh},
    {"", with_prior, take_with_prior},
    {k_readings_left_out, without_doubted, judge_doubted},
    {"azimuths turned", azimuths_turned_back, judge_turned_azimuths},
    {"reading left out", without_first_suspect, judge_first_suspect},
};

}  // namespace

std::span<const Hypothesis> hypotheses() {
    return k_hypotheses;
}

Problem with_few_starts(Problem problem, const Attempt& first) {
    problem.options.starts =
        std::min(problem.options.starts, first.work > k_trials.dear_work ? 1 : k_trials.few_starts);
    return problem;
}

}  // namespace culet
