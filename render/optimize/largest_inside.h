#pragma once
// The largest copy of a convex solid that another holds.

#include "stone/solid/solid.h"

namespace culet {

struct LargestInside {
    double scale = 1;   ///< of the copy
    Vec3 shift{0};      ///< after scaling about the origin, mm
    double volume = 0;  ///< of the copy, mm3
};

/// `cut` scaled and moved, not turned, as large as `stone` holds it: a linear program in the scale
/// and the three shifts. Both solids are convex and bounded. Rounding may leave the scale wrong,
/// and the copy outside of the stone, by 1e-11 of the scale and of the stone's diameter.
LargestInside largest_inside(const Solid& cut, const Solid& stone);

/// The copy.
Solid moved_inside(Solid cut, const LargestInside& inside);

}  // namespace culet
