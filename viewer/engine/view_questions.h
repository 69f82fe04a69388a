#pragma once
// Questions about a place in the picture: pixels from its upper left corner, x to the right, y
// down.

#include <array>
#include <string>
#include <vector>

#include "render/scene/scene.h"

namespace culet {

/// The facet there, or -1 where the stone is not met.
int facet_at(const Stone& stone, const Camera& camera, double x, double y);

struct PickedFacet {
    int facet = 0;
    std::vector<std::array<double, 2>> points;
};
/// Throws InputError for a conoscope.
std::vector<PickedFacet> seen_facets(const Stone& stone, const Camera& camera);

/// Writes what `culet probe --json` writes. Throws InputError.
std::string paths_at(const Scene& scene, double x, double y);

}  // namespace culet
