#pragma once
// How a set of outlines and a body lie to each other. Private to the room.

#include <span>
#include <vector>

#include "fit/silhouettes/outline_distances.h"

namespace culet {

/// place_in_set_frame = scale * turn(place_in_body) + shift: of a body in the frame of a set.
struct Similarity {
    FrameMotion motion;
    double scale = 1;
    Vec3 placed(const Vec3& v) const { return motion.turned(scale * v) + motion.shift; }
};

struct RegistrationOptions {
    bool turns = true, shifts = true, scales = false;
};

/// The similarity nearest to `start` at which the contours of one set lie nearest to the body: by
/// damped Gauss-Newton steps of a robust least squares, whose scale goes down with the distances.
Similarity registered(std::span<const Vec3> corners, std::span<const FlatContour> contours,
                      const Similarity& start, const RegistrationOptions& options);

std::vector<Vec3> placed_corners(std::span<const Vec3> corners, const Similarity& at);

/// Sum of weighted squares of one set's distances, those beyond `k_sure` scales as if at that.
double registration_cost(std::span<const Vec3> corners, std::span<const FlatContour> contours,
                         const Similarity& at, double scale);

/// A start from nothing: the axis is normal to all directions of sight where they lie in a plane (a
/// turntable), else one of the three axes of the set's frame; the body stands upright (+z) on
/// either end of it, is scaled to the outlines' widths, and is turned about the axis in steps of
/// two degrees. The holder may hide one end of the stone. The few best are registered.
/// `up`: of the body. Places that the body's symmetry makes the same are one.
Similarity found_registration(std::span<const Vec3> corners, const Vec3& up,
                              std::span<const FlatContour> contours);

/// The inverse of a rigid motion.
FrameMotion inverse(const FrameMotion& motion);

}  // namespace culet
