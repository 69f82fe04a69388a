#pragma once
// How far readings whose azimuth zero is free stand turned against a shape.

#include <functional>
#include <vector>

#include "fit/readings/measurement.h"

namespace culet {

/// The turn about up, in radians, after which the normals' azimuths agree best with those read: the
/// mean direction of their differences. 0 where none was read.
double azimuth_turn(const std::vector<Reading>& readings,
                    const std::function<Vec3(int facet)>& normal_of);

}  // namespace culet
