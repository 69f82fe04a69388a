#include "fit/uncertainty/meet_sigmas.h"

#include <algorithm>
#include <cmath>

#include "fit/model/enclosed.h"
#include "fit/uncertainty/constants.h"
#include "fit/uncertainty/diagnostics.h"
#include "fit/uncertainty/meet_likelihood.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

using Sigmas = MeetSigmas;

// Foerstner (1979): each group's variance is sum of squares / redundancy, repeated until it agrees
// with that of the weights.
void agree_with_residuals(FitModel& model, Finished& finished, const FitOptions& options,
                          const Progress& progress) {
    for (int round = 0; round < 60; ++round) {
        if (progress && !progress(0.7 + 0.004 * round)) throw Interrupted();
        const Diagnosis d = diagnose(model, finished.shape, finished.outline, {.full = false});
        double largest = 0;
        Sigmas sigmas = model.meets().group_sigmas;
        for (std::size_t g = 0; g < d.group_squares.size(); ++g) {
            if (!(d.group_redundancy[g] > 0.5)) continue;
            const double before = sigmas[g];
            const double change =
                0.5 * std::log(std::max(1e-30, d.group_squares[g]) / d.group_redundancy[g]) -
                std::log(before);
            largest = std::max(largest, std::abs(change));
            sigmas[g] =
                std::max(k_meet_size.least_sigma, before * std::exp(std::clamp(change, -2.0, 2.0)));
        }
        model.set_group_sigmas(sigmas);
        // No estimate of an uncertainty is better than 1 %. Until then three steps do, as weights
        // change again.
        const bool agrees = largest < 1e-2;
        const int steps = finished.iterations;
        finished = finish(model, finished.shape, agrees ? options.iterations : 3);
        finished.iterations += steps;
        if (agrees) return;
    }
    const int steps = finished.iterations;
    finished = finish(model, finished.shape, options.iterations);
    finished.iterations += steps;
}

struct Solution {
    Sigmas sigmas;
    Finished finished;
    double likelihood = 0;  // -2 log likelihood
};

// Scans each group alone, then both together.
Sigmas best_of_scan(MeetLikelihood& likelihood, const Sigmas& from, double& least) {
    Sigmas best = from;
    const auto try_at = [&](const Sigmas& sigmas) {
        const double value = likelihood(sigmas);
        if (!(value < least)) return;
        least = value;
        best = sigmas;
    };
    for (const auto& [first, second] :
         {std::pair(true, false), std::pair(false, true), std::pair(true, true)}) {
        if ((first && !likelihood.has(0)) || (second && !likelihood.has(1))) continue;
        for (double s = k_meet_size.scan_from; s < k_meet_size.scan_to;
             s *= k_meet_size.scan_step) {
            try_at({first ? s : from[0], second ? s : from[1]});
        }
    }
    return best;
}

// A solution without room for some facet is no stone of this mesh.
bool has_all_facets(const FitModel& model, const Finished& finished) {
    if (!finished.enclosed) return false;
    const Enclosed enclosed = enclosed_by(model, finished.shape);
    return enclosed.closed && enclosed.missing.empty();
}

bool is_same(const Sigmas& a, const Sigmas& b) {
    return std::abs(std::log(a[0] / b[0])) < k_meet_size.same_solution &&
           std::abs(std::log(a[1] / b[1])) < k_meet_size.same_solution;
}

}  // namespace

int estimate_meet_sigmas(FitModel& model, Finished& finished, const FitOptions& options,
                         const Progress& progress) {
    agree_with_residuals(model, finished, options, progress);
    std::vector<Solution> solutions;
    solutions.push_back({model.meets().group_sigmas, finished, 0});
    std::size_t best = 0;
    int steps = finished.iterations;
    for (std::size_t at = 0;
         at < solutions.size() && int(solutions.size()) < k_meet_size.most_solutions; ++at) {
        if (!solutions[at].finished.outline) break;
        model.set_group_sigmas(solutions[at].sigmas);
        MeetLikelihood likelihood(model, solutions[at].finished);
        solutions[at].likelihood = likelihood(solutions[at].sigmas);
        if (solutions[at].likelihood < solutions[best].likelihood) best = at;
        double least = solutions[at].likelihood - 2 * k_meet_size.another;
        const Sigmas there = best_of_scan(likelihood, solutions[at].sigmas, least);
        if (is_same(there, solutions[at].sigmas)) continue;
        model.set_group_sigmas(there);
        Solution solution{there, finish(model, solutions[at].finished.shape, options.iterations),
                          0};
        agree_with_residuals(model, solution.finished, options, progress);
        steps += solution.finished.iterations;
        solution.sigmas = model.meets().group_sigmas;
        const bool known = std::any_of(
            solutions.begin(), solutions.end(),
            [&](const Solution& other) { return is_same(other.sigmas, solution.sigmas); });
        if (!known && has_all_facets(model, solution.finished))
            solutions.push_back(std::move(solution));
    }
    model.set_group_sigmas(solutions[best].sigmas);
    finished = std::move(solutions[best].finished);
    finished.iterations = steps;
    return static_cast<int>(solutions.size());
}

}  // namespace culet
