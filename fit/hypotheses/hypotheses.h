#pragma once
// What may be wrong if a fit found no stone or contradictory readings: one list, tried in order.
// Private to the room.

#include <optional>
#include <span>

#include "fit/hypotheses/problem.h"

namespace culet {

/// A hypothesis judged by the changed problem's fit; empty: it does not hold.
struct Verdict {
    std::optional<FitResult> explained;  ///< result of the problem as given, with the explanation
    std::optional<Problem> next;         ///< the same hypothesis with another change
};

struct Hypothesis {
    /// For the report's list `changed`; empty if nothing given is changed.
    const char* what;
    /// The changed problem; nothing if the hypothesis does not apply.
    std::optional<Problem> (*changed)(const Problem& given, const Attempt& first);
    Verdict (*judged)(const Problem& given, const Attempt& first, const Problem& changed,
                      FitResult again);
};

std::span<const Hypothesis> hypotheses();

/// How often a hypothesis may change the problem.
inline constexpr int k_most_changes = 2;

}  // namespace culet
