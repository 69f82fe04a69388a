#pragma once
// Girdle outlines seen from above, with the places of the mains and of the breaks between them.

#include <vector>

#include "stone/solid/solid.h"

namespace culet {

/// Points in counter-clockwise order: mains[0] (azimuth 0), breaks[0], mains[1], breaks[1], ...
/// `tangents[i]` is the girdle's direction at main i.
struct Outline {
    std::vector<Vec2> mains, breaks, tangents;
    /// Further girdle corners between mains[i] and breaks[i] (arcs[2 i]), and between breaks[i] and
    /// mains[i + 1] (arcs[2 i + 1]). Empty: the girdle is straight there.
    std::vector<std::vector<Vec2>> arcs;
    int notch = -1;  ///< the break that is a notch (heart); -1: the outline is convex
};

/// Each stretch between a main and a break has `segments` (at least 1) girdle facets.
Outline ellipse_outline(double length, double width, int mains, int segments = 1);
/// Two circular arcs that meet in points at +x and -x.
Outline marquise_outline(double length, double width);
/// A half circle at -x, and two arcs that continue it smoothly to a point at +x.
Outline pear_outline(double length, double width);
/// Three arcs; `bulge` is their sagitta as a fraction of the side. A corner at +x.
Outline trillion_outline(double width, double bulge);
/// |x/a|^p + |y/b|^p = 1 (Lame).
Outline cushion_outline(double length, double width, double exponent);
/// Two lobes with a notch at -x, a point at +x.
Outline heart_outline(double length, double width);

}  // namespace culet
