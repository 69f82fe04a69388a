#include "fit/findings/assess.h"

#include <cmath>

#include "fit/findings/blunder.h"
#include "fit/findings/cut_quantities.h"
#include "fit/findings/optimal_design.h"
#include "fit/findings/rank_defect.h"
#include "fit/uncertainty/covariance.h"

namespace culet {

namespace {

Proposal proposal_of(const System& system, const Suspicion& suspicion) {
    const Reading& reading = system.readings()[std::size_t(suspicion.reading)];
    Proposal proposal;
    proposal.id = reading.id;
    proposal.in_radians = is_angle(reading.kind);
    proposal.estimate = suspicion.estimate;
    proposal.sigma = suspicion.sigma;
    for (const int other : suspicion.alternatives) {
        proposal.alternatives.push_back(system.readings()[std::size_t(other)].id);
    }
    if (is_relation(reading.kind)) return proposal;
    // A slip is an explanation only where the tolerance is small beside what it explains.
    const double off = std::abs(reading.value - suspicion.estimate);
    if (slip_tolerance(reading, suspicion.sigma) < 0.25 * off) explain_by_slip(reading, proposal);
    return proposal;
}

}  // namespace

void assess(const System& system, const Finished& finished, const Diagnosis& diagnosis,
            FitResult& result) {
    for (const Suspicion& s : diagnosis.suspicions) {
        result.findings.proposals.push_back(proposal_of(system, s));
    }
    for (const int r : diagnosis.disagreeing) {
        result.findings.disagreeing.push_back(system.readings()[std::size_t(r)].id);
    }
    if (!diagnosis.covariance || !finished.outline) return;
    const Covariance& covariance = *diagnosis.covariance;
    const RowWriter writer(finished.shape);
    for (const CutQuantity& q : cut_quantities(system, finished.shape, finished.outline)) {
        const FunctionRow row = writer.function(q.quantity);
        result.findings.proportions.push_back(
            {q.name, q.unit, q.factor * q.quantity.value,
             q.factor * std::sqrt(covariance.total_variance(row))});
    }
    result.findings.undetermined_words =
        describe_open_freedoms(system, finished.shape, covariance, diagnosis.undetermined);
    result.findings.help = next_readings(system, finished.shape, finished.outline, covariance);
}

}  // namespace culet
