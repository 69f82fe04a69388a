#pragma once
// A fit from one mesh, compared with the fit that starts at the truth.

#include <optional>
#include <string>

#include "fit/fit.h"
#include "tests/fit/fit_truth.h"

namespace culet::bench {

struct Trial {
    FitResult result;
    std::string refusal;  ///< the message of an InputError
    double cpu = 0;       ///< seconds
};
Trial fit_mesh(const Stone& mesh, const std::vector<WrittenReading>& readings,
               const FitOptions& options = {});

/// Has all declared facets, is closed, strictly convex by exact predicates, and planar to 1e-12.
bool is_valid(const Stone& declared, const FitResult& result);
/// Valid, and at the same statistical optimum: chi-square is at most max(4, 5 %) above the
/// reference's.
bool succeeds(const Stone& declared, const Trial& trial, const Trial& reference);

}  // namespace culet::bench
