#pragma once
// What may be wrong with a problem whose fit found no stone, or readings that contradict each
// other: one list, tried in its order. Private to the room.

#include <optional>
#include <span>

#include "fit/hypotheses/problem.h"

namespace culet {

/// What the fit of a changed problem says of a hypothesis; neither: it does not hold.
struct Verdict {
    std::optional<FitResult> explained;  ///< the result of the problem as given, and in words why
    std::optional<Problem> next;         ///< the same hypothesis, changed otherwise
};

struct Hypothesis {
    /// What is changed, for the report's list `changed`; empty: nothing that was given.
    const char* what;
    /// The problem as it would be; nothing where the hypothesis does not apply.
    std::optional<Problem> (*changed)(const Problem& given, const Attempt& first);
    Verdict (*judged)(const Problem& given, const Attempt& first, const Problem& changed,
                      FitResult again);
};

std::span<const Hypothesis> hypotheses();

/// How often a hypothesis may change the problem.
inline constexpr int k_most_changes = 2;

}  // namespace culet
