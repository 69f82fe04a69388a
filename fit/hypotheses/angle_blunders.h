#pragma once
// Angles so wrong that no stone has them: an azimuth half a turn off, an inclination counted from
// the other side. Least squares finds no stone then, or one bent out of shape that accuses the
// neighbours; the mesh, however rough, knows better. Private to the room.

#include "fit/hypotheses/hypotheses.h"
#include "fit/model/system.h"

namespace culet {

/// Inclinations and azimuths (of single facets, from up) that are off the mesh by far more than the
/// others (small facets counted less): six times the median, and ten degrees. Indices; at most a
/// tenth of all.
std::vector<std::size_t> angles_far_from_mesh(const System& system);

/// Where the fit found no stone, or its readings disagree and it does not name one of these alone:
/// the problem without them.
std::optional<Problem> without_far_angles(const Problem& given, const Attempt& first);

/// Holds if the fit without them contradicts all of them and explains more. Where it contradicts
/// some, those alone are left out next; where none, the fit goes on from there with all readings.
Verdict judge_far_angles(const Problem& given, const Attempt& first, const Problem& changed,
                         FitResult again);

}  // namespace culet
