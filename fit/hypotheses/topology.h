#pragma once
// Changes of the topology that readings ask for, where the user allows them. Private to the room.
//
// An edge that the readings want of no length or less collapses: its two corners become one meet.
// When they want it below zero by more than its uncertainty explains, that meet is let go, and the
// planes put the edge on the other side (a flip). Facets that no room is left for go, meets that
// the readings contradict come apart. After each change the stone is fitted anew; the result is
// held to the same exact checks as any.

#include <functional>
#include <vector>

#include "fit/findings/result.h"

namespace culet {

/// A fit of this stone to these readings, as the first was made but with all topology kept.
using FitAgain = std::function<FitResult(const Stone&, const std::vector<Reading>&)>;

/// `first` is the fit of `stone` without changes. At most `k_most_rounds` rounds; each takes all
/// changes that do not touch each other. `FitResult::changes` lists them, and the edges that came
/// and went in the end; readings of facets and edges that are gone keep their place in the result,
/// with no fitted value.
FitResult fit_with_changes(const Stone& stone, const std::vector<Reading>& readings,
                           const FitOptions& options, FitResult first, const FitAgain& fit);

inline constexpr int k_most_rounds = 8;

/// The solid with each of these edges (by its corners) drawn together; facets left with fewer than
/// three corners are gone. Empty when that is no closed surface any more.
Solid with_collapsed_edges(const Solid& solid, const std::vector<std::pair<int, int>>& edges);

}  // namespace culet
