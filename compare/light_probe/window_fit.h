#pragma once
// Fits a rectangle to outlines seen from several places.

#include <array>
#include <optional>
#include <vector>

#include "stone/solid/solid.h"

namespace culet {

/// A line of sight to the light's edge from a place near the origin.
struct EdgeSight {
    Vec3 from, direction;  ///< unit direction
};

/// All edge sights from one place. A place after the first may be rotated about itself by an
/// unknown small angle.
struct SeenOutline {
    std::vector<EdgeSight> sights;
    Vec3 place{0, 0, 0};
    double sigma = 1e-3;      ///< of a line of sight, across it, radians
    double turned_sigma = 0;  ///< of the whole place about each axis, radians; 0: exact
};

/// Middle and half-extents; u and v are perpendicular.
struct Window {
    Vec3 middle, u, v;
};

struct WindowFit {
    Window window;
    double nearness = 0, nearness_sigma = 0;  ///< 1 / distance of the middle from the origin
    double tilt = 0, tilt_sigma = 0;          ///< radians; 0: facing the origin
    bool facing = false;                      ///< the tilt is not identifiable and taken as 0
    double residual = 0;                      ///< root mean square over all sights, radians
};

/// Minimises the angles by which lines of sight miss the nearest edge (Ceres). Free are the
/// middle's direction and 1 / distance (so an infinitely far light is no special case), the turn,
/// the extents, the tilt, and the places' rotations within their sigmas. A given `nearness` is
/// fixed, and the window then faces the origin, because a single place cannot tell a tilted window
/// from a narrower one. It also faces the origin when the tilt's sigma is over half a radian.
/// Sigmas come from the sights' sigmas or the residuals, whichever is larger. Nothing when the
/// outlines are too short for eight unknowns.
std::optional<WindowFit> fit_window(const std::vector<SeenOutline>& outlines,
                                    const std::optional<double>& nearness);

/// Root mean square angle by which the sights miss the edges of a measured window.
double missed_angle(const Window& window, const std::vector<SeenOutline>& outlines);

}  // namespace culet
