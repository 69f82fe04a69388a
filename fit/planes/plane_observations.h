#pragma once
// What something that is no single reading (outlines, a photograph) tells of a stone's planes.

#include <vector>

#include "stone/solid/solid.h"

namespace culet {

/// Made linear: for each row, the sum over the facets of normal . (n - planes.normal) +
/// offset * (d - planes.offset) is `value` within one.
struct PlaneObservations {
    struct Row {
        std::vector<Vec3> normal;    ///< of each facet
        std::vector<double> offset;  ///< of each facet, per length
        double value = 0;
    };
    std::vector<Plane> planes;  ///< outlines: as the mesh stands; photographs: as it is fitted
    std::vector<Row> rows;
};

}  // namespace culet
