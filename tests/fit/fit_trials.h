#pragma once
// One fit from one mesh, judged against the fit that starts from the truth.

#include <optional>
#include <string>

#include "fit/fit.h"
#include "tests/fit/fit_truth.h"

namespace culet::bench {

struct Trial {
    FitResult result;
    std::string refusal;  ///< an InputError's words
    double cpu = 0;       ///< seconds
};
Trial fit_mesh(const Stone& mesh, const std::vector<WrittenReading>& readings,
               const FitOptions& options = {});

/// All declared facets, closed, strictly convex by exact predicates, planar to 1e-12.
bool is_valid(const Stone& declared, const FitResult& result);
/// Valid, and the same statistical optimum: chi-square within max(4, 5 %) of the reference's, or
/// better.
bool succeeds(const Stone& declared, const Trial& trial, const Trial& reference);

}  // namespace culet::bench
