#pragma once
// What outlines tell of the planes, in the scale and place of the fit.

#include <vector>

#include "stone/solid.h"

namespace culet {

/// As OutlineKnowledge (silhouettes/silhouette_fit.h): for each row, the sum over all facets of
/// normal . (n - normals) + offset * (d - offsets) is zero within one, where n is turned back about
/// up to stand as the stone did when it was seen.
struct OutlineRows {
    std::vector<Vec3> normals;
    std::vector<double> offsets;
    struct Row {
        std::vector<Vec3> normal;
        std::vector<double> offset;
    };
    std::vector<Row> rows;
    bool turns = true;  ///< the outlines do not say how the stone stands about up
};

}  // namespace culet
