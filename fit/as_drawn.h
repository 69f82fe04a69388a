#pragma once
// What the readings leave open, as the mesh has it. The search for a stone moves open freedoms
// along with the others: a girdle of which nothing was read would end leaning. Private to the room.

#include <optional>
#include <vector>

#include "fit/fit.h"
#include "fit/portfolio.h"
#include "fit/system.h"

namespace culet {

/// The end of the fit from which the same readings leave the facets that they do not hold facing
/// most nearly as in the mesh, as far as it is planar enough to say; nothing where no other is
/// found whose chi-square is the same.
/// `open`: what nothing measured fixes there. Throws Interrupted when progress says so.
std::optional<Candidate> end_as_drawn(const System& system, const Candidate& end,
                                      const std::vector<Undetermined>& open, FitOptions options,
                                      const Progress& progress = {});

}  // namespace culet
