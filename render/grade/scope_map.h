#pragma once
// A scope's view of a stone as a map: for each point, the part of the eye's light that exits into
// each band of directions.

#include <vector>

#include "render/grade/scope_shares.h"

namespace culet {

/// Square, centred on the silhouette; rows from the top (EyeLight::up) down.
struct ScopeMap {
    int size = 0;
    double half_width = 0;              ///< of the map, in the solid's unit
    double radius = 0;                  ///< of the circle with the silhouette's area
    std::vector<BandShares> shares;     ///< per point; all 0 outside the silhouette
    std::vector<ScopeBand> brightest;   ///< per point: the band with the largest part
    std::vector<unsigned char> inside;  ///< 1 within the silhouette
};

/// `light`: with regions. The outer reflection is left out, since it does not depend on the inside.
ScopeMap scope_map(const EyeLight& light, const ScopeBands& bands, int size);

}  // namespace culet
