#include "tests/fit/fit_trials.h"

#include <algorithm>

#include "stone/solid/checks.h"
#include "stone/text/errors.h"
#include "tests/cpu_time.h"

namespace culet::bench {

Trial fit_mesh(const Stone& mesh, const std::vector<WrittenReading>& readings,
               const FitOptions& options) {
    Trial trial;
    const double start = clocks().cpu;
    try {
        trial.result = fit_stone(fit_input(mesh, readings), options);
    } catch (const InputError& error) {
        trial.refusal = error.what();
    }
    trial.cpu = clocks().cpu - start;
    return trial;
}

bool is_valid(const Stone& declared, const FitResult& result) {
    const Solid& solid = result.solid;
    if (solid.facets.size() != declared.solid.facets.size()) return false;
    for (const Facet& f : declared.solid.facets) {
        if (find_facet(solid, f.name) < 0) return false;
    }
    return is_closed(solid) && is_convex(solid) && planarity(solid) < 1e-12 * diameter(solid) &&
           find_faults(solid, {.planarity = 1e-12}).empty();
}

bool succeeds(const Stone& declared, const Trial& trial, const Trial& reference) {
    return trial.refusal.empty() && is_valid(declared, trial.result) &&
           trial.result.statistics.chi2 <
               reference.result.statistics.chi2 +
                   std::max(4.0, 0.05 * reference.result.statistics.chi2);
}

}  // namespace culet::bench
