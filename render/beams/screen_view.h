#pragma once
// A view from one point of the pupil as linear maps: from the picture's x and y to eye rays, and
// from points to the picture.

#include <array>
#include <glm/geometric.hpp>
#include <vector>

#include "render/scene/scene.h"

namespace culet {

struct ScreenPoint {
    double x = 0, y = 0;  ///< pixels, as in EyeRays
};

/// Homogeneous image of a point: x w, y w, w.
using ScreenImage = Vec3;

/// The eye ray through (x, y) starts at o + x ox + y oy and runs along v + x vx + y vy.
struct ScreenView {
    Vec3 o{0}, ox{0}, oy{0}, v{0}, vx{0}, vy{0};
    bool parallel = false;  ///< orthographic without a lens: the eye is at infinity
    int width = 0, height = 0;
    Vec3 forward{0, 0, 1}, right{1, 0, 0};
    std::array<Vec3, 3> rows;  ///< of the map from a point to its image
    Vec3 row_offsets{0};

    Vec3 origin(const ScreenPoint& p) const { return o + p.x * ox + p.y * oy; }
    Vec3 towards(const ScreenPoint& p) const { return v + p.x * vx + p.y * vy; }
    ScreenImage of_point(const Vec3& point) const { return of_direction(point) + row_offsets; }
    ScreenImage of_direction(const Vec3& d) const {
        return {glm::dot(rows[0], d), glm::dot(rows[1], d), glm::dot(rows[2], d)};
    }
    /// True if the eye is on the plane's outer side.
    bool sees(const Plane& plane) const;
    bool operator==(const ScreenView&) const = default;
};

/// `pupil_x`, `pupil_y`: a point of the unit disc of the pupil. Throws InputError for a conoscope,
/// whose rays do not meet in a point of the pupil.
ScreenView screen_view(const Camera& camera, double pupil_x = 0, double pupil_y = 0);

/// From points of the pupil with equal areas: Vogel's sunflower (1979).
std::vector<ScreenView> pupil_views(const Camera& camera, int points);

}  // namespace culet
