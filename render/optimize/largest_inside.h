#pragma once
// Finds the largest copy of a convex solid inside another.

#include "stone/solid/solid.h"

namespace culet {

struct LargestInside {
    double scale = 1;   ///< of the copy
    Vec3 shift{0};      ///< after scaling about the origin, mm
    double volume = 0;  ///< of the copy, mm3
};

/// The largest scaled and moved, not rotated, `cut` that fits into `stone`: a linear program in the
/// scale and three shifts. Both solids are convex and bounded. Rounding may change the scale, and
/// let the copy protrude, by 1e-11 of the scale and of the stone's diameter.
LargestInside largest_inside(const Solid& cut, const Solid& stone);

/// Returns the copy.
Solid moved_inside(Solid cut, const LargestInside& inside);

}  // namespace culet
