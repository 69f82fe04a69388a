#include "fit/fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>

#include "fit/find_symmetry.h"
#include "fit/findings/assess.h"
#include "fit/findings/describe.h"
#include "fit/findings/first_check.h"
#include "fit/findings/fitted_parts.h"
#include "fit/findings/judge.h"
#include "fit/findings/shape_findings.h"
#include "fit/findings/symmetry_tests.h"
#include "fit/findings/tier_findings.h"
#include "fit/mesh/notes.h"
#include "fit/mesh/repair.h"
#include "fit/model/system.h"
#include "fit/readings/level_facets.h"
#include "fit/retries/angle_blunders.h"
#include "fit/retries/leave_one_out.h"
#include "fit/retries/topology.h"
#include "fit/retries/turned_azimuths.h"
#include "fit/retries/unread_size.h"
#include "fit/solve/free_meets.h"
#include "fit/starts/multistart.h"
#include "fit/starts/refit.h"
#include "fit/starts/robust.h"
#include "fit/uncertainty/diagnostics.h"
#include "fit/uncertainty/meet_sigmas.h"
#include "fit/uncertainty/prior_needed.h"
#include "fit/uncertainty/statistics.h"
#include "stone/errors.h"

namespace culet {

const char* name_of(FitStatus status) {
    switch (status) {
        case FitStatus::converged:
            return "converged";
        case FitStatus::not_converged:
            return "not_converged";
        case FitStatus::contradictory:
            return "contradictory";
        case FitStatus::undetermined:
            return "undetermined";
    }
    return "not_converged";
}

namespace {

// What a fit tries again when its readings contradict each other or leave no stone: without angles
// that are far off the mesh; with azimuths turned back, and without its first suspect, too.
enum class Tries { nothing, without_far_angles, all };
FitResult fit(const Stone& drawn, const std::vector<Reading>& readings, const FitOptions& options,
              const Progress& progress, Tries tries);

// A gross error: beyond this the equations' bend matters. Of suspects only: next to corners that
// are held, readings that nothing checks have residuals that say nothing.
bool needs_robust_view(const Diagnosis& diagnosis) {
    return std::any_of(diagnosis.suspects.begin(), diagnosis.suspects.end(), [&](int reading) {
        return std::abs(diagnosis.readings[std::size_t(reading)].normalized) > 8;
    });
}

std::vector<Reading> without(const std::vector<Reading>& readings,
                             const std::vector<std::size_t>& left_out) {
    std::vector<Reading> others;
    for (std::size_t i = 0; i < readings.size(); ++i) {
        if (!std::binary_search(left_out.begin(), left_out.end(), i)) {
            others.push_back(readings[i]);
        }
    }
    return others;
}

// In how many rounds those that are wrong are told from those that only seem so.
constexpr int k_most_rounds = 2;
// Where the wrong reading was found, the stone is soon found too. One start is enough where those
// of all readings were dear: a large stone, or readings of none.
constexpr int k_starts_without = 2;
constexpr double k_dear = 2e9;

FitOptions with_few_starts(FitOptions options, const Multistart& all) {
    options.starts = std::min(options.starts, all.work > k_dear ? 1 : k_starts_without);
    return options;
}

// A fit that angles far off the mesh have spoilt, again without those that it then contradicts; or,
// when it contradicts none of them, from where it ends. Nothing when that explains no more.
std::optional<FitResult> fit_without_blunders(const FitResult& spoilt, const Stone& stone,
                                              const std::vector<Reading>& readings,
                                              std::vector<std::size_t> far,
                                              const FitOptions& options, const Progress& progress) {
    const bool any_will_do = spoilt.status == FitStatus::not_converged;
    for (int round = 0; round < k_most_rounds && !far.empty(); ++round) {
        FitResult result = fit(stone, without(readings, far), options, progress, Tries::nothing);
        if (result.status == FitStatus::not_converged) return std::nullopt;
        const std::vector<std::size_t> wrong = contradicted_angles(result, readings, far);
        if (wrong.empty()) {
            FitOptions from_there = options;
            from_there.start = result.solid;
            const std::string start = result.start;
            result = fit(stone, readings, from_there, progress, Tries::nothing);
            result.start = start;
            if (result.status == FitStatus::not_converged) return std::nullopt;
            if (any_will_do || result.chi2 < spoilt.chi2) return result;
            return std::nullopt;
        }
        if (wrong.size() == far.size()) {
            put_back_blunders(readings, far, result);
            // What explains a contradiction takes most of chi-square with it.
            if (any_will_do || result.chi2 < 0.5 * spoilt.chi2) return result;
            return std::nullopt;
        }
        far = wrong;
    }
    return std::nullopt;
}

FitResult fit(const Stone& drawn, const std::vector<Reading>& readings, const FitOptions& options,
              const Progress& progress, Tries tries) {
    if (const auto left_out = meaningless_azimuths(readings); !left_out.empty()) {
        FitResult result = fit(drawn, without(readings, left_out), options, progress, tries);
        put_left_out(readings, left_out, result);
        return result;
    }
    if (!says_size(readings)) {
        std::vector<Reading> with_size = readings;
        with_size.push_back(size_of_mesh(drawn));
        FitResult result = fit(drawn, with_size, options, progress, tries);
        take_back_size(with_size.back(), result);
        return result;
    }
    const auto begin = std::chrono::steady_clock::now();
    const auto seconds_since_begin = [begin] {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    };
    const std::optional<Stone> mirrored = mirrored_to_azimuths(drawn, readings);
    const Stone& stone = mirrored ? *mirrored : drawn;
    FitOptions used = options;
    if (options.prior.source != Prior::Source::none && !options.prior.always &&
        readings_hold_all(stone, readings, options)) {
        used.prior.source = Prior::Source::none;
    }
    System system(stone, readings, used);
    FitResult result;
    result.options = used;
    if (options.allow_topology) result.options.findings = true;
    result.unit = stone.unit;

    std::optional<Candidate> again;
    if (const auto shape = options.start ? shape_of(system, *options.start) : std::nullopt) {
        again = refit_from(system, *shape, options.iterations);
    }
    const bool goes_on = again && again->is_an_end();
    Multistart multistart;
    if (goes_on) {
        multistart.best = std::move(*again);
    } else {
        multistart = fit_from_starts(system, options, progress);
    }
    Candidate& best = multistart.best;
    const std::vector<double> weights =
        options.loss == Loss::none ? std::vector<double>()
                                   : reweight(system, best, options.loss, options.iterations);
    result.starts = multistart.starts;
    result.start = best.start;
    result.vanishing_edges = edges_kept_open(system, best.held);
    result.vanishing_chi2 = best.cost_of_holding;
    if (mirrored) {
        result.notes.push_back(
            "by the azimuths read, the mesh is the mirror image of the stone: it was mirrored");
    }
    if (const std::string note = other_turn(system); !note.empty()) result.notes.push_back(note);
    if (const std::string note = other_size(system); !note.empty()) result.notes.push_back(note);
    if (progress && !progress(0.7)) throw Interrupted();
    if (system.has_estimated_groups()) {
        result.meets.ends = estimate_meet_sigmas(system, best.finished, options, progress);
    }
    if (progress && !progress(0.95)) throw Interrupted();

    const Finished& finished = best.finished;
    const Diagnosis diagnosis = [&] {
        Diagnosis plain = diagnose(system, finished.shape, finished.outline,
                                   {.significance = options.significance,
                                    .binding = best.binding,
                                    .held = conditions_of(finished.shape, best.held)});
        if (!needs_robust_view(plain) || options.loss != Loss::none) return plain;
        // A gross error bends the whole stone: look for it from a fit that it does not pull.
        System reweighted = system;
        Candidate robust = best;
        reweight(reweighted, robust, Loss::cauchy, options.iterations);
        if (!robust.sound || !robust.finished.outline) return plain;
        return diagnose(system, finished.shape, finished.outline,
                        {.significance = options.significance,
                         .binding = best.binding,
                         .seen_from = &robust.finished});
    }();
    const System::Pose pose = system.pose_of(finished.shape);
    result.iterations = finished.iterations;
    result.chi2 = diagnosis.chi2;
    result.dof = diagnosis.dof;
    result.chi2_p = chi2_tail(diagnosis.chi2, diagnosis.dof);
    result.chi2_limit = chi2_quantile(options.significance, diagnosis.dof);
    result.suspect_limit = diagnosis.suspect_limit;
    result.undetermined = diagnosis.undetermined;
    result.rank_defect = diagnosis.rank_defect;
    fill_in(system, readings, finished.shape, diagnosis, pose, weights, result);
    assess(system, finished, diagnosis, result);
    describe_findings(system, finished, best.held, diagnosis, pose, result);
    if (options.find_symmetry &&
        std::any_of(readings.begin(), readings.end(), declares_whole_symmetry)) {
        FitOptions from_here = options;
        from_here.start = result.solid;
        from_here.allow_topology = false;
        result.symmetry = find_symmetry(stone, readings, from_here, progress);
    }
    judge(system, finished, diagnosis, result);
    // By counting, the readings held it all; here they do not.
    if (options.prior.source != Prior::Source::none && !system.has_prior() &&
        (result.status == FitStatus::undetermined || result.status == FitStatus::not_converged)) {
        FitOptions with_prior = options;
        with_prior.prior.always = true;
        return fit(drawn, readings, with_prior, progress, tries);
    }
    if (tries == Tries::all && stone.azimuth_from_mesh && !mirrored) {
        auto better = fit_turning_azimuths_back(
            result, readings, system.mesh_turn(), [&](const std::vector<Reading>& back) {
                return fit(drawn, back, with_few_starts(options, multistart), progress,
                           Tries::without_far_angles);
            });
        if (better) {
            better->options = result.options;
            better->seconds = seconds_since_begin();
            return *better;
        }
    }
    if (const auto far = angles_far_from_mesh(system);
        tries != Tries::nothing && may_be_bent(result, readings, far)) {
        auto better = fit_without_blunders(result, drawn, readings, far,
                                           with_few_starts(options, multistart), progress);
        if (better) result = std::move(*better);
    }
    if (tries == Tries::all) {
        auto better =
            fit_leaving_one_out(result, readings, [&](const std::vector<Reading>& others) {
                return fit(drawn, others, with_few_starts(options, multistart), progress,
                           Tries::without_far_angles);
            });
        if (better) result = std::move(*better);
    }
    result.options.starts = options.starts;
    result.seconds = seconds_since_begin();
    if (options.allow_topology) {
        FitOptions plain = options;
        plain.allow_topology = false;
        plain.findings = true;
        result = fit_with_changes(stone, readings, options, std::move(result),
                                  [&](const Stone& changed, const std::vector<Reading>& moved) {
                                      return fit_stone(changed, moved, plain, progress);
                                  });
        result.seconds = seconds_since_begin();
    }
    if (progress) progress(1);
    return result;
}

}  // namespace

FitResult fit_stone(const Stone& stone, const std::vector<Reading>& readings,
                    const FitOptions& options, const Progress& progress) {
    const bool is_design = options.prior.source == Prior::Source::catalogue;
    std::vector<Doubt> doubts;
    const auto fit_the_rest = [&] {
        std::vector<std::size_t> doubted;
        for (const Doubt& d : doubts) doubted.push_back(d.reading);
        std::sort(doubted.begin(), doubted.end());
        FitResult result = fit(stone, without(readings, doubted), options, progress, Tries::all);
        if (!doubts.empty()) put_back_doubted(readings, doubts, result);
        return result;
    };
    // Readings that hold the stone check each other, and better.
    const bool few = options.first_check && !readings_hold_all(stone, readings, options);
    if (few) doubts = first_check(stone, readings, is_design);
    FitResult result = fit_the_rest();
    if (options.first_check && !few && result.prior.source != Prior::Source::none) {
        // After all they do not.
        doubts = first_check(stone, readings, is_design);
        if (!doubts.empty()) result = fit_the_rest();
    }
    result.named_tiers = tier_findings(stone, readings, result.suspects, is_design);
    return result;
}

}  // namespace culet
