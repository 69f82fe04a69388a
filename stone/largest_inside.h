#pragma once
// The largest copy of a convex solid that another holds.

#include "stone/solid.h"

namespace culet {

struct LargestInside {
    double scale = 1;   ///< of the copy
    Vec3 shift{0};      ///< after scaling about the origin
    double volume = 0;  ///< of the copy
};

/// `cut` scaled and moved, not turned, as large as `stone` holds it: the linear programme of the
/// scale and the three shifts (CGAL, exact). Both convex and bounded.
LargestInside largest_inside(const Solid& cut, const Solid& stone);

/// The copy.
Solid moved_inside(Solid cut, const LargestInside& inside);

}  // namespace culet
