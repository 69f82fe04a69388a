#pragma once
// Facets whose azimuth nothing but short edges tells: turned to one side or to the other, such a
// facet has edges of nearly the same lengths, and the readings an end for each side. Private to the
// room.

#include <optional>

#include "fit/portfolio.h"

namespace culet {

/// A sound end of less chi-square on the other side of the ridge between two such ends, if there is
/// one. The facets whose azimuth is least known, if not to a degree, are swung to either side, all
/// else following as the readings ask (the regression on that azimuth), and the readings decide
/// where that ends. `end` has to be sound.
std::optional<Candidate> better_with_facets_swung(const System& system, const Candidate& end,
                                                  int iterations);

}  // namespace culet
