#pragma once
// Tries several starts, one after another, until one leads to a stone that could be cut and that
// agrees with the readings.

#include <string>
#include <vector>

#include "fit/model/fit_model.h"
#include "fit/model/options.h"
#include "fit/solve/active_set.h"
#include "fit/starts/constants.h"
#include "stone/progress/progress.h"

namespace culet {

struct Candidate : ActiveSetFit {
    std::string start;
    bool sound = false;   ///< closed, convex where it must be, with all facets
    bool agrees = false;  ///< passes the chi-square test
    int binding = 0;      ///< how many of `held` bind; each counts like one more exact reading

    /// A stone that could be cut and whose hard equations hold.
    bool holds() const { return sound && finished.worst_hard < k_hard_limit; }
    bool is_local_minimum() const { return holds() && finished.converged; }
};

struct Multistart {
    Candidate best;
    int starts = 0;   ///< tried
    double work = 0;  ///< of all starts, in multiplications (estimate)
};

/// Runs the last stage from a shape that is nearly right.
Candidate finish_candidate(const FitModel& model, Relaxation& relaxation, const Shape& shape,
                           const ActiveSetOptions& options);

/// Accepts the first candidate that is sound and agrees, or a sound stone reached twice (the
/// readings then contradict each other, and no start will help). Gives up after several starts in a
/// row without improvement. Otherwise returns the best of `options.starts`. Throws Interrupted when
/// progress says so.
Multistart fit_from_starts(const FitModel& model, const FitOptions& options,
                           const Progress& progress = {});

}  // namespace culet
