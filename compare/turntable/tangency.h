#pragma once
// A turntable's pose before the camera, and how far the stone turned, from planes that touch two
// outlines. Lines of sight are taken as parallel.

#include <array>
#include <glm/vec2.hpp>
#include <vector>

#include "compare/turntable/stepped_turns.h"

namespace culet {

/// Corners of an outline's convex hull; x to the right, y up, pixels from the picture's middle.
struct OutlineHull {
    std::vector<glm::dvec2> corners;
    bool at_top = false, at_bottom = false;  ///< cut off there
};

/// How far two outlines disagree at a tangent plane that they share.
struct TangentGap {
    std::size_t one = 0, other = 0;
    double px = 0;
};

struct Tangency {
    /// Where the axis crosses the picture's middle row, its roll (radians, clockwise) and the
    /// camera's elevation above the table's plane.
    std::array<double, 3> table{0, 0, 0};
    std::vector<double> turns;  ///< of the stone, counter-clockwise from above
    SteppedTurns expected;      ///< how the turntable stepped, if turns are not exact
    double residual_px = 0;     ///< root mean square disagreement at common tangent planes
    int tangents = 0;
    std::vector<TangentGap> gaps;    ///< in outlines less than half a turn apart
    std::array<double, 3> sigmas{};  ///< of `table`, from the residuals
};

struct TangencyOptions {
    std::vector<double> elevations;  ///< where to start, radians; the best end is taken
    /// The camera looks down. (Seen from below, a mirrored stone that turns the other way has the
    /// same outlines.)
    bool from_above = false;
    /// Of each turn, radians, about even steps, of which some may be missing or doubled and which
    /// need not close; 0: turns are exact, and outlines half a turn apart must be equally far from
    /// the axis.
    double turn_sigma = 0;
};

/// A plane through two lines of sight that touches the stone appears in both outlines at one
/// distance from the origin (Wong and Cipolla 2001, Cipolla and Giblin 2000). Throws InputError if
/// no two pictures are half a turn apart while turns are exact.
Tangency tangency_of(const std::vector<OutlineHull>& hulls, const std::vector<double>& turns,
                     const TangencyOptions& options);

}  // namespace culet
