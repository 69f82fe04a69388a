#pragma once
// Edges and facets that the readings deny or leave open. Private to the room.

#include <string>
#include <vector>

#include "fit/findings/findings.h"
#include "fit/solve/active_set.h"
#include "fit/solve/free_meets.h"
#include "fit/uncertainty/covariance.h"
#include "fit/uncertainty/diagnostics.h"

namespace culet {

/// In the scale of the fit. `holding`: with the held corners as hard equations. Vanishing edges
/// come from corners held below a neighbour facet, by the force with which the readings pull at
/// them (as in `meet_tests.h`); open ones from lengths, areas and angles less than twice their
/// standard uncertainty. Only edges shorter than `k_short_edge` are looked at. `level` is the level
/// of each test of a wish to vanish.
std::vector<ShapeFinding> find_open_shape(const System& system, const Finished& finished,
                                          const std::vector<ActiveCorner>& held,
                                          const Diagnosis& diagnosis, const Covariance& holding);

/// The edges, as `A/B`, that corners held below a facet keep from turning over.
std::vector<std::string> edges_kept_open(const System& system,
                                         const std::vector<ActiveCorner>& held);

/// Of the half diameter.
inline constexpr double k_short_edge = 0.05;

}  // namespace culet
