#pragma once
// How far the azimuths read stand turned against a shape.

#include <functional>
#include <vector>

#include "fit/readings/measurement.h"

namespace culet {

/// The turn about up, in radians, after which the normals' azimuths agree best with those read: the
/// mean direction of their differences. 0 where none was read. With `zero_is_meshs` they were said
/// to count from where the shape's do: 0 also where the mean direction is not five of its standard
/// errors away, sqrt((1 - R2) / 2n) / R with the mean resultant lengths R and, about the mean and
/// of doubled angles, R2 (Fisher 1993, 4.4.4). A rough drawing's facets are turned by chance.
double azimuth_turn(const std::vector<Reading>& readings,
                    const std::function<Vec3(int facet)>& normal_of, bool zero_is_meshs);

}  // namespace culet
