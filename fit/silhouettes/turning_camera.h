#pragma once
// A camera that stands still before a turntable.

#include <array>
#include <vector>

#include "stone/solid/solid.h"

namespace culet {

/// The turntable's axis is +z of the stone's frame; at turn 0 the camera is over +x. A place falls
/// on the picture at (axis, 0) + rotation by -roll of (right, up) / (1 - perspective * nearness):
/// x to the right, y up, in the stone's unit at the frame's origin. The origin is the axis' point
/// that appears in the picture's row 0.
struct TurningCamera {
    double axis = 0;         ///< where the axis crosses row 0
    double roll = 0;         ///< of the axis in the picture, radians, clockwise
    double elevation = 0;    ///< of the camera above the table's plane, radians
    double perspective = 0;  ///< 1 / distance from the origin; 0: lines of sight are parallel

    std::array<double, 4> values() const { return {axis, roll, elevation, perspective}; }
};

/// What is known of camera and turns before outlines are fitted.
struct ExpectedSeries {
    TurningCamera camera;
    /// Standard deviations of axis, roll, elevation and perspective; 0: not known.
    std::array<double, 4> sigmas{};
    std::vector<double> turns;
    double turn_sigma = 0.01;  ///< radians
};

/// Pictures of one stone, each with its own turn, counter-clockwise from above, in radians.
struct TurningSeries {
    TurningCamera camera;
    std::vector<double> turns;
};

/// place_in_picture = (dx, dy) + (across . x, along . x) / (1 - nearing . x)
struct PictureAxes {
    Vec3 across{1, 0, 0}, along{0, 1, 0}, nearing{0, 0, 0};
    double dx = 0, dy = 0;
};
PictureAxes picture_axes(const TurningCamera& camera, double turn);

}  // namespace culet
