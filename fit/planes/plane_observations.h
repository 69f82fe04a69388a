#pragma once
// What observations of several planes together (outlines, a photograph) tell of a stone's planes.

#include <vector>

#include "stone/solid/solid.h"

namespace culet {

/// Linearised: for each row, the sum over the facets of normal . (n - planes.normal) + offset * (d
/// - planes.offset) equals `value` with a sigma of one.
struct PlaneObservations {
    struct Row {
        std::vector<Vec3> normal;    ///< of each facet
        std::vector<double> offset;  ///< of each facet, per unit of length
        double value = 0;
    };
    std::vector<Plane> planes;  ///< outlines: in the mesh's frame; photographs: in the result's
    std::vector<Row> rows;
};

}  // namespace culet
