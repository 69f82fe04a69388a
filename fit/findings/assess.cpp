#include "fit/findings/assess.h"

#include <cmath>

#include "fit/findings/blunder.h"
#include "fit/findings/cut_quantities.h"
#include "fit/findings/optimal_design.h"
#include "fit/findings/rank_defect.h"
#include "fit/uncertainty/covariance.h"

namespace culet {

void assess(const FitModel& model, const Finished& finished, const Diagnosis& diagnosis,
            FitResult& result) {
    const auto reading = [&](int r) -> const Reading& { return model.readings()[std::size_t(r)]; };
    for (const Suspicion& s : diagnosis.suspicions) {
        // The others are not sure of each other: a slip must leave little of what it explains.
        constexpr double k_part_missed = 0.25;
        Proposal proposal = proposal_for(reading(s.reading), s.estimate, s.sigma, k_part_missed);
        for (const int other : s.alternatives) proposal.alternatives.push_back(reading(other).id);
        result.findings.proposals.push_back(std::move(proposal));
    }
    for (const int r : diagnosis.disagreeing) {
        result.findings.disagreeing.push_back(reading(r).id);
    }
    if (!diagnosis.covariance || !finished.outline) return;
    const Covariance& covariance = *diagnosis.covariance;
    const RowWriter writer(finished.shape);
    for (const CutQuantity& q : cut_quantities(model, finished.shape, finished.outline)) {
        const FunctionRow row = writer.function(q.quantity);
        result.findings.proportions.push_back(
            {q.name, q.unit, q.factor * q.quantity.value,
             q.factor * std::sqrt(covariance.total_variance(row))});
    }
    result.findings.undetermined_words =
        describe_open_freedoms(model, finished.shape, covariance, diagnosis.undetermined);
    result.findings.help = next_readings(model, finished.shape, finished.outline, covariance);
}

}  // namespace culet
