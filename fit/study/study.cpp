#include "fit/study/study.h"

#include "fit/study/parts.h"

namespace culet {

Study study_fit(const Stone& stone, const std::vector<Reading>& readings,
                const StudyOptions& options, const Progress& progress) {
    Study study;
    study.options = options;
    // Decided by the stone itself, not by every draw.
    study.options.fit.findings = study.options.fit.find_symmetry = false;
    study.options.fit.allow_topology = false;
    study.stone = stone.name;
    study.unit = stone.unit;
    study.facets = static_cast<int>(stone.solid.facets.size());
    study.readings = static_cast<int>(readings.size());
    StudyBudget budget(options.budget_seconds, progress);
    const double begin = processor_seconds();
    const FitResult base = fit_stone(stone, readings, study.options.fit,
                                     [&](double) { return !progress || progress(0); });
    study.seconds = processor_seconds() - begin;
    study.status = base.status;
    study.message = base.message;
    if (!is_sound(stone, base)) {
        study.limit_message = "there is no fitted stone to study";
        return study;
    }
    // Half of the time for each part, plus what the first leaves over.
    if (options.times) {
        budget.allow((options.limits ? 0.5 : 1) * options.budget_seconds);
        study_settings(stone, readings, base, budget, study);
    }
    if (options.limits) {
        budget.allow(options.budget_seconds);
        study_limits(stone, base, truth_of(stone, readings, base), budget, study);
    }
    budget.report(1);
    return study;
}

}  // namespace culet
