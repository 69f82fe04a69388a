#pragma once
// Angles so wrong that no stone has them: an azimuth half a turn off, an inclination counted from
// the other side. Least squares finds no stone then, or one bent out of shape that accuses the
// neighbours; the mesh, however rough, knows better. Private to the room.

#include <vector>

#include "fit/findings/result.h"
#include "fit/model/system.h"

namespace culet {

/// Inclinations and azimuths (of single facets, from up) that are off the mesh by far more than the
/// others (small facets counted less): six times the median, and ten degrees. Indices; at most a
/// tenth of all.
std::vector<std::size_t> angles_far_from_mesh(const System& system);

/// Whether a fit with this result would do better without them: it found no stone, or its readings
/// disagree and more than one is named, or another than these first.
bool may_be_bent(const FitResult& result, const std::vector<Reading>& readings,
                 const std::vector<std::size_t>& far);

/// Which of them the result of a fit without them contradicts beyond its suspect limit,
/// and by five degrees.
std::vector<std::size_t> contradicted_angles(const FitResult& without,
                                             const std::vector<Reading>& readings,
                                             const std::vector<std::size_t>& far);

/// The result of a fit without these angles with them in their places again, accused.
void put_back_blunders(const std::vector<Reading>& readings,
                       const std::vector<std::size_t>& blunders, FitResult& result);

}  // namespace culet
