#pragma once
// Finds the turn between the azimuths read and those of a shape.

#include <functional>
#include <vector>

#include "fit/readings/measurement.h"

namespace culet {

/// Returns the turn about up, in radians, that best brings the normals' azimuths to those read: the
/// mean direction of the differences. 0 when none was read.
///
/// With `counted_from_mesh` the azimuths were said to count from where the shape's do. The turn is
/// then also 0 unless it exceeds five of its standard errors, because a rough drawing's facets are
/// turned by chance. The standard error is sqrt((1 - R2) / 2n) / R, with the mean resultant lengths
/// R and, of doubled angles about the mean, R2 (Fisher 1993, 4.4.4).
double azimuth_turn(const std::vector<Reading>& readings,
                    const std::function<Vec3(int facet)>& normal_of, bool counted_from_mesh);

}  // namespace culet
