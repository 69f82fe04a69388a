#pragma once
// What outlines or a photograph tell of the planes, in the scale and place of the fit.

#include <vector>

#include "stone/solid.h"

namespace culet {

/// As PlaneKnowledge (planes/plane_knowledge.h): for each row, the sum over all facets of
/// normal . (n - normals) + offset * (d - offsets) is `value` within one, where n is turned back
/// about up to stand as the stone did when it was seen.
struct KnownPlanes {
    std::vector<Vec3> normals;
    std::vector<double> offsets;
    struct Row {
        std::vector<Vec3> normal;
        std::vector<double> offset;
        double value = 0;
    };
    std::vector<Row> rows;
    bool turns = true;  ///< it is not known how the stone stands about up
};

}  // namespace culet
