#pragma once
// Cuts with straight sides: step cuts and the princess.

#include <vector>

#include "stone/solid/solid.h"

namespace culet {

struct StepTier {
    double angle = 0.7;  ///< of every facet of the tier, radians
    double height = 1;   ///< mm
};

struct StepProportions {
    double length = 8, width = 6,
           corner = 1;  ///< mm; `corner`: length that each corner takes off a side
    double girdle = 0.15;
    std::vector<StepTier> crown,
        pavilion;  ///< from the girdle outwards; the last pavilion tier ends in the keel
};

/// Has eight sides (four when `corner` is 0). All sides of a tier have one slope, so tiers meet in
/// level edges and the pavilion ends in a keel. Throws InputError when tiers close before the
/// table.
Solid step_cut(const StepProportions& proportions);

struct PrincessProportions {
    double length = 6, width = 6;  ///< mm
    double table = 0.68, girdle = 0.15, crown_height = 0.6, pavilion_depth = 3.5;
    int chevrons = 3;
};

/// A rectangle with sharp corners: two crown tiers, and a pavilion of chevrons that fan out from
/// the corners.
Solid princess_cut(const PrincessProportions& proportions);

}  // namespace culet
