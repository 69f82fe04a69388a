#include "fit/attempt.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "fit/findings/assess.h"
#include "fit/findings/describe.h"
#include "fit/findings/fitted_parts.h"
#include "fit/findings/judge.h"
#include "fit/findings/shape_findings.h"
#include "fit/mesh/notes.h"
#include "fit/model/system.h"
#include "fit/starts/multistart.h"
#include "fit/starts/refit.h"
#include "fit/starts/robust.h"
#include "fit/uncertainty/diagnostics.h"
#include "fit/uncertainty/meet_evidence.h"
#include "fit/uncertainty/meet_sigmas.h"
#include "fit/uncertainty/statistics.h"
#include "stone/errors.h"

namespace culet {

namespace {

// From an earlier result, where it leads to an end; else from the starts.
Multistart search(const System& system, const FitOptions& options, const Progress& progress) {
    if (const auto shape = options.start ? shape_of(system, *options.start) : std::nullopt) {
        Multistart again;
        again.best = refit_from(system, *shape, options.iterations);
        // Outlines have led to the stone already: other starts would lead to none.
        if (again.best.is_an_end() || system.has_outlines()) return again;
    }
    return fit_from_starts(system, options, progress);
}

void fill_in_search(const System& system, const Multistart& multistart, FitResult& result) {
    const Candidate& best = multistart.best;
    result.log.starts = multistart.starts;
    result.log.start = best.start;
    result.log.iterations = best.finished.iterations;
    result.findings.vanishing_edges = edges_kept_open(system, best.held);
    result.findings.vanishing_chi2 = best.cost_of_holding;
    const bool has_size = result.log.options.mesh_has_size;
    for (std::string note : {other_turn(system), has_size ? other_size(system) : std::string()}) {
        if (!note.empty()) result.log.notes.push_back(std::move(note));
    }
}

void fill_in_statistics(const Diagnosis& diagnosis, FitResult& result) {
    const double significance = result.log.options.significance;
    result.statistics.chi2 = diagnosis.chi2;
    result.statistics.dof = diagnosis.dof;
    result.statistics.chi2_p = chi2_tail(diagnosis.chi2, diagnosis.dof);
    result.statistics.chi2_low_p = chi2_lower_tail(diagnosis.chi2, diagnosis.dof);
    result.statistics.chi2_limit = chi2_quantile(significance, diagnosis.dof);
    result.statistics.suspect_limit = diagnosis.suspect_limit;
    result.findings.undetermined = diagnosis.undetermined;
    result.statistics.rank_defect = diagnosis.rank_defect;
}

bool asks_for_evidence(const System& system, const FitOptions& options) {
    return !options.meets_named && options.meets == MeetTreatment::exact &&
           options.prior.source != Prior::Source::none && options.loss == Loss::none &&
           !options.free_corners && !system.has_outlines();
}

// Beside a prior nothing else would contradict exact meets: they would pull planes off good
// readings. The system and the stone that the readings make likelier.
void decide_meets(const Problem& problem, FitOptions& options, std::optional<System>& system,
                  Candidate& best) {
    if (!best.is_an_end() || !asks_for_evidence(*system, options)) return;
    FitOptions other = options;
    other.meets = MeetTreatment::soft;
    std::optional<System> changed(std::in_place, problem.stone, problem.readings, other);
    if (!changed->has_common_meets()) return;  // three planes always meet
    std::optional<MeetEvidence> evidence = weigh_meets(*changed, best.finished, other);
    if (!evidence) return;
    Candidate candidate = best;
    if (evidence->exact) {
        other = options;
        other.meets_shown = true;
        changed.emplace(problem.stone, problem.readings, other);
        candidate = finish_from(*changed, best.finished.shape, options.iterations);
        candidate.start = best.start;
    } else {
        candidate.finished = std::move(evidence->finished);
        candidate.held.clear();
        candidate.cost_of_holding = 0;
        candidate.binding = 0;
        const System::Enclosed enclosed = changed->enclosed(candidate.finished.shape);
        candidate.sound = enclosed.closed && enclosed.missing.empty();
    }
    if (!candidate.is_an_end()) return;
    options = other;
    system.emplace(std::move(*changed));
    best = std::move(candidate);
}

void tell(const Progress& progress, double done) {
    if (progress && !progress(done)) throw Interrupted();
}

}  // namespace

Attempt attempt(const Problem& problem, const Progress& progress) {
    Attempt made;
    FitResult& result = made.result;
    FitOptions& options = result.log.options = problem.options;
    if (problem.read_in_full && !options.prior.always) options.prior.source = Prior::Source::none;
    result.unit = problem.stone.unit;
    std::optional<System> taken(std::in_place, problem.stone, problem.readings, options);
    made.mesh_turn = taken->mesh_turn();

    Multistart multistart = search(*taken, options, progress);
    made.work = multistart.work;
    Candidate& best = multistart.best;
    decide_meets(problem, options, taken, best);
    System& system = *taken;
    const std::vector<double> weights =
        options.loss == Loss::none ? std::vector<double>()
                                   : reweight(system, best, options.loss, options.iterations);
    fill_in_search(system, multistart, result);
    tell(progress, 0.7);
    if (system.has_estimated_groups() && problem.options.meets != MeetTreatment::exact) {
        result.statistics.meets.ends =
            estimate_meet_sigmas(system, best.finished, options, progress);
    }
    tell(progress, 0.95);

    const Finished& finished = best.finished;
    const Diagnosis diagnosis =
        diagnose(system, finished.shape, finished.outline,
                 {.significance = options.significance, .binding = best.binding});
    const System::Pose pose = system.pose_of(finished.shape);
    fill_in_statistics(diagnosis, result);
    fill_in(system, problem.readings, finished.shape, diagnosis, pose, weights, result);
    assess(system, finished, diagnosis, result);
    describe_findings(system, finished, best.held, diagnosis, pose, result);
    judge(system, finished, diagnosis, result);
    return made;
}

}  // namespace culet
