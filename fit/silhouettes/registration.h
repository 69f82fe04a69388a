#pragma once
// Registers a set of outlines with a body. Private to the room.

#include <span>
#include <vector>

#include "fit/silhouettes/outline_distances.h"

namespace culet {

/// place_in_set_frame = scale * turn(place_in_body) + shift.
struct Similarity {
    FrameMotion motion;
    double scale = 1;
    Vec3 placed(const Vec3& v) const { return motion.turned(scale * v) + motion.shift; }
};

struct RegistrationOptions {
    bool turns = true, shifts = true, scales = false;
};

/// The similarity near `start` that brings the body closest to one set's contours: damped
/// Gauss-Newton steps of a robust least squares whose scale shrinks with the distances.
Similarity registered(std::span<const Vec3> corners, std::span<const FlatContour> contours,
                      const Similarity& start, const RegistrationOptions& options);

std::vector<Vec3> placed_corners(std::span<const Vec3> corners, const Similarity& at);

/// Sum of weighted squares of one set's distances, each capped at `k_sure` scales.
double registration_cost(std::span<const Vec3> corners, std::span<const FlatContour> contours,
                         const Similarity& at, double scale);

/// Finds a start. The axis is normal to all lines of sight if they lie in a plane (a turntable),
/// else one of the three axes of the set's frame. The body stands upright (+z) on either end of it,
/// is scaled to the outlines' widths and turned in steps of two degrees. The holder may hide one
/// end. The few best places are registered; places equal by the body's symmetry count once. `up` is
/// the body's.
Similarity found_registration(std::span<const Vec3> corners, const Vec3& up,
                              std::span<const FlatContour> contours);

/// The inverse of a rigid motion.
FrameMotion inverse(const FrameMotion& motion);

}  // namespace culet
