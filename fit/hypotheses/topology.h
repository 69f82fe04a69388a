#pragma once
// Changes the topology where readings ask for it and the user allows it. Private to the room.
//
// An edge to which the readings give no length collapses: its corners become one meet. If they ask
// for a negative length beyond its uncertainty, that meet is released, and the planes put the edge
// on the other side (a flip). Facets without room go; meets that the readings contradict come
// apart. After each change the stone is fitted anew; the result passes the usual exact checks.

#include <functional>
#include <vector>

#include "fit/findings/result.h"

namespace culet {

/// Fits like the first time, but with all topology kept.
using FitAgain = std::function<FitResult(const Stone&, const std::vector<Reading>&)>;

/// `first` is the fit of `stone` without changes. Each of at most `k_most_rounds` rounds makes all
/// changes that do not touch each other. `FitResult::changes` lists them, and the edges that came
/// and went. Readings of facets and edges that are gone stay in the result, without a fitted value.
FitResult fit_with_changes(const Stone& stone, const std::vector<Reading>& readings,
                           const FitOptions& options, FitResult first, const FitAgain& fit);

inline constexpr int k_most_rounds = 8;

/// The solid with these edges (by their corners) collapsed; facets with fewer than three corners
/// go. Empty if no closed surface is left.
Solid with_collapsed_edges(const Solid& solid, const std::vector<std::pair<int, int>>& edges);

}  // namespace culet
