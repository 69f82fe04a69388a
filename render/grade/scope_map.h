#pragma once
// What a scope sees of a stone as a map: at each point the share of the eye's light that leaves
// into each band of directions.

#include <vector>

#include "render/grade/scope_shares.h"

namespace culet {

/// Square, the silhouette's middle in its middle; rows from the top (EyeLight::up) down.
struct ScopeMap {
    int size = 0;
    double half_width = 0;              ///< of the map, in the solid's unit
    double radius = 0;                  ///< of the circle with the silhouette's area
    std::vector<BandShares> shares;     ///< by point; outside of the silhouette all 0
    std::vector<ScopeBand> brightest;   ///< by point: the band with the most
    std::vector<unsigned char> inside;  ///< 1 within the silhouette
};

/// `light`: with regions. The outer reflection is left out: it is the same whatever is inside.
ScopeMap scope_map(const EyeLight& light, const ScopeBands& bands, int size);

}  // namespace culet
