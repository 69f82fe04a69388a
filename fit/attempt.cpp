#include "fit/attempt.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "fit/findings/describe.h"
#include "fit/mesh/notes.h"
#include "fit/model/enclosed.h"
#include "fit/model/fit_model.h"
#include "fit/starts/multistart.h"
#include "fit/starts/refit.h"
#include "fit/starts/robust.h"
#include "fit/uncertainty/diagnostics.h"
#include "fit/uncertainty/meet_evidence.h"
#include "fit/uncertainty/meet_sigmas.h"
#include "fit/uncertainty/statistics.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

Multistart search(const FitModel& model, const FitOptions& options, const Progress& progress) {
    if (const auto shape = options.start ? shape_of(model, *options.start) : std::nullopt) {
        Multistart again;
        again.best = refit_from(model, *shape, options.iterations);
        // Outlines have already led to the stone; no other start does better.
        if (again.best.is_local_minimum() || model.has_outlines()) return again;
    }
    return fit_from_starts(model, options, progress);
}

void fill_in_search(const FitModel& model, const Multistart& multistart, FitResult& result) {
    const Candidate& best = multistart.best;
    result.log.starts = multistart.starts;
    result.log.start = best.start;
    result.log.iterations = best.finished.iterations;
    result.findings.vanishing_chi2 = best.cost_of_holding;
    const bool has_size = result.log.options.mesh_has_size;
    for (std::string note : {other_turn(model), has_size ? other_size(model) : std::string()}) {
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

bool asks_for_evidence(const FitModel& model, const FitOptions& options) {
    return !options.meets_named && options.meets == MeetTreatment::exact &&
           options.prior.source != Prior::Source::none && options.loss == Loss::none &&
           !options.free_corners && !model.has_outlines();
}

// Beside a prior nothing would contradict exact meets, which would then pull planes off good
// readings. Replaces the model and the stone by the alternative that the readings make likelier.
void decide_meets(const Problem& problem, FitOptions& options, std::optional<FitModel>& model,
                  Candidate& best) {
    if (!best.is_local_minimum() || !asks_for_evidence(*model, options)) return;
    FitOptions other = options;
    other.meets = MeetTreatment::soft;
    std::optional<FitModel> changed(std::in_place, problem.stone, problem.readings, other);
    if (!changed->meets().has_common()) return;  // three planes always meet
    std::optional<MeetEvidence> evidence = weigh_meets(*changed, best.finished, other);
    if (!evidence) return;
    Candidate candidate = best;
    if (evidence->exact) {
        other = options;
        other.exact_meets_supported = true;
        changed.emplace(problem.stone, problem.readings, other);
        candidate = finish_from(*changed, best.finished.shape, options.iterations);
        candidate.start = best.start;
    } else {
        candidate.finished = std::move(evidence->finished);
        candidate.held.clear();
        candidate.cost_of_holding = 0;
        candidate.binding = 0;
        const Enclosed enclosed = enclosed_by(*changed, candidate.finished.shape);
        candidate.sound = enclosed.closed && enclosed.missing.empty();
    }
    if (!candidate.is_local_minimum()) return;
    options = other;
    model.emplace(std::move(*changed));
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
    std::optional<FitModel> taken(std::in_place, problem.stone, problem.readings, options);
    made.mesh_turn = taken->frame().mesh_turn();

    Multistart multistart = search(*taken, options, progress);
    made.work = multistart.work;
    Candidate& best = multistart.best;
    decide_meets(problem, options, taken, best);
    FitModel& model = *taken;
    const std::vector<double> weights =
        options.loss == Loss::none ? std::vector<double>()
                                   : reweight(model, best, options.loss, options.iterations);
    fill_in_search(model, multistart, result);
    tell(progress, 0.7);
    if (model.meets().has_estimated_groups() && problem.options.meets != MeetTreatment::exact) {
        result.statistics.meets.local_maxima =
            estimate_meet_sigmas(model, best.finished, options, progress);
    }
    tell(progress, 0.95);

    const Finished& finished = best.finished;
    const Diagnosis diagnosis =
        diagnose(model, finished.shape, finished.outline,
                 {.significance = options.significance, .binding = best.binding});
    const Frame::Pose pose = model.frame().pose_of(finished.shape);
    fill_in_statistics(diagnosis, result);
    fill_in(model, problem.readings, finished.shape, diagnosis, pose, weights, result);
    describe_findings(model, finished, best.held, diagnosis, pose, result);
    judge(model, finished, diagnosis, result);
    return made;
}

}  // namespace culet
