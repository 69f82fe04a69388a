#pragma once
// The rectangle whose edges lie on the outlines that several places saw of it.

#include <array>
#include <optional>
#include <vector>

#include "stone/solid/solid.h"

namespace culet {

/// A line of sight from a place near the origin: it passes the light's edge.
struct EdgeSight {
    Vec3 from, direction;  ///< unit direction
};

/// All that one place saw of the edge. What places after the first saw may be turned, about the
/// place, by some unknown small angle against the first.
struct SeenOutline {
    std::vector<EdgeSight> sights;
    Vec3 place{0, 0, 0};
    double sigma = 1e-3;      ///< of a line of sight, across it, radians
    double turned_sigma = 0;  ///< of the whole place about each axis, radians; 0: exact
};

/// Middle and half-extents; u and v are at right angles.
struct Window {
    Vec3 middle, u, v;
};

struct WindowFit {
    Window window;
    double nearness = 0, nearness_sigma = 0;  ///< 1 / distance of the middle from the origin
    double tilt = 0, tilt_sigma = 0;          ///< radians against facing the origin
    bool facing = false;                      ///< the tilt could not be told: taken as 0
    double residual = 0;                      ///< root mean square over all sights, radians
};

/// Least squares over the angles by which lines of sight miss the nearest edge (Ceres). Free are
/// the middle's direction and 1 / distance, the turn, the extents, the tilt, and the places' turns
/// within their sigmas; nothing in the formulas blows up where the light is infinitely far. With
/// `nearness` given it is held, and the window faces the origin: one place alone cannot tell a
/// tilted window from a narrower one. The tilt is kept where it is known to half a radian; a window
/// of which less is known is taken to face the origin. Sigmas are those of the sights or of what
/// the residuals show, whichever is more. Nothing: the outlines are too short for eight unknowns.
std::optional<WindowFit> fit_window(const std::vector<SeenOutline>& outlines,
                                    const std::optional<double>& nearness);

/// Root mean square angle by which the sights miss the edges of a window that was measured
/// otherwise.
double missed_angle(const Window& window, const std::vector<SeenOutline>& outlines);

}  // namespace culet
