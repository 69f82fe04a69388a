#include "fit/uncertainty/meet_evidence.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fit/model/prior.h"
#include "fit/uncertainty/meet_likelihood.h"

namespace culet {

namespace {

// Sizes that are looked at, of the usual miss: up to 2 % of the width, where meets hold nothing any
// more. Finer than a factor of 1.25 no sigma is known by a hundred readings.
constexpr double k_least_part = 0.02, k_most_part = 20, k_ratio = 1.25;
// The largest size that the readings allow is taken, within one standard error of the likeliest: a
// sigma that is too small pulls planes off good readings, one that is too large forgoes a little.
constexpr double k_allowed = 1;
// Meets that miss by less are exact: 0.01 % of the width turns a facet of a sixth of it by 0.03
// degrees, which no goniometer shows.
constexpr double k_exact_part = 0.1;
// Rounds of estimate and fit; a change of less is of no matter.
constexpr int k_rounds = 3;
constexpr double k_same = 0.1;

// In parts of the usual miss; 0 where nothing can be said. The evidence is what the readings are
// likely by: meets beside the prior have a likelihood even without them, which is no evidence, and
// is the larger, the smaller the sigma.
double allowed_part(const System& system, const Finished& at, double usual) {
    MeetLikelihood read(system, at), unread(system, at, false);
    double allowed = 0, least = std::numeric_limits<double>::infinity();
    for (double part = k_least_part; part < k_most_part; part *= k_ratio) {
        const MeetSigmas sigmas{part * usual, part * usual};
        const double misfit = read(sigmas) - unread(sigmas);
        if (!std::isfinite(misfit)) continue;
        least = std::min(least, misfit);
        if (misfit <= least + k_allowed) allowed = part;
    }
    return allowed;
}

}  // namespace

std::optional<MeetEvidence> weigh_meets(System& system, const Finished& at,
                                        const FitOptions& options) {
    const double usual = k_meet_miss * 2 * system.half_width();
    MeetEvidence evidence;
    evidence.finished = at;
    double before = 0;
    for (int round = 0; round < k_rounds; ++round) {
        const double part = allowed_part(system, evidence.finished, usual);
        if (round == 0 && !(part > 0)) return std::nullopt;
        if (round == 0 && part <= k_exact_part) {
            evidence.exact = true;
            return evidence;
        }
        if (!(part > 0) || (before > 0 && std::abs(std::log(part / before)) < k_same)) break;
        before = part;
        system.set_group_sigma(0, part * usual);
        system.set_group_sigma(1, part * usual);
        const int steps = evidence.finished.iterations;
        evidence.finished = finish(system, evidence.finished.shape, options.iterations);
        evidence.finished.iterations += steps;
        if (!evidence.finished.enclosed) break;
    }
    return evidence;
}

}  // namespace culet
