#include "fit/uncertainty/meet_evidence.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fit/model/constants.h"
#include "fit/model/prior.h"
#include "fit/uncertainty/constants.h"
#include "fit/uncertainty/meet_likelihood.h"

namespace culet {

namespace {

// Part of the usual miss; 0 if unknown. Counts the likelihood of the readings alone: meets beside
// the prior have one of their own, which grows as sigma shrinks.
double allowed_part(const FitModel& model, const Finished& at, double usual) {
    MeetLikelihood read(model, at), unread(model, at, false);
    double allowed = 0, least = std::numeric_limits<double>::infinity();
    for (double part = k_evidence.least_part; part < k_evidence.most_part;
         part *= k_evidence.ratio) {
        const MeetSigmas sigmas{part * usual, part * usual};
        const double misfit = read(sigmas) - unread(sigmas);
        if (!std::isfinite(misfit)) continue;
        least = std::min(least, misfit);
        if (misfit <= least + k_evidence.allowed) allowed = part;
    }
    return allowed;
}

}  // namespace

std::optional<MeetEvidence> weigh_meets(FitModel& model, const Finished& at,
                                        const FitOptions& options) {
    const double usual = k_prior.meet_miss * 2 * model.frame().half_width();
    MeetEvidence evidence;
    evidence.finished = at;
    double before = 0;
    for (int round = 0; round < k_evidence.rounds; ++round) {
        const double part = allowed_part(model, evidence.finished, usual);
        if (round == 0 && !(part > 0)) return std::nullopt;
        if (round == 0 && part <= k_evidence.exact_part) {
            evidence.exact = true;
            return evidence;
        }
        if (!(part > 0) || (before > 0 && std::abs(std::log(part / before)) < k_evidence.same))
            break;
        before = part;
        model.set_group_sigmas({part * usual, part * usual});
        const int steps = evidence.finished.iterations;
        evidence.finished = finish(model, evidence.finished.shape, options.iterations);
        evidence.finished.iterations += steps;
        if (!evidence.finished.enclosed) break;
    }
    return evidence;
}

}  // namespace culet
