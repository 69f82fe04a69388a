#pragma once
// Changes the topology where readings ask for it and the user allows it. Private to the room.
//
// An edge to which the readings give no length collapses: its two corners become one meet. If they
// ask for a negative length beyond its uncertainty, that meet is released, and the planes put the
// edge on the other side (a flip). Facets without room are removed; meets that the readings
// contradict come apart. After each change the stone is fitted anew; the result passes the same
// exact checks as any.

#include <functional>
#include <vector>

#include "fit/findings/result.h"

namespace culet {

/// Fits this stone to these readings, as the first fit but with all topology kept.
using FitAgain = std::function<FitResult(const Stone&, const std::vector<Reading>&)>;

/// `first` is the fit of `stone` without changes. There are at most `k_most_rounds` rounds; each
/// makes all changes that do not touch each other. `FitResult::changes` lists them, and the edges
/// that came and went in the end. Readings of facets and edges that are gone stay in the result,
/// without a fitted value.
FitResult fit_with_changes(const Stone& stone, const std::vector<Reading>& readings,
                           const FitOptions& options, FitResult first, const FitAgain& fit);

inline constexpr int k_most_rounds = 8;

/// The solid with each of these edges (given by its corners) collapsed; facets left with fewer than
/// three corners are gone. Empty if the result is no closed surface.
Solid with_collapsed_edges(const Solid& solid, const std::vector<std::pair<int, int>>& edges);

}  // namespace culet
