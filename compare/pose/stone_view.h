#pragma once
// A camera as seen from the stone: which way the stone is turned, where in the picture it is and
// how large. In these terms the unknowns of a view hardly pull at each other, which position,
// look_at and fov do, and a camera infinitely far away is a number like any other.

#include <array>
#include <glm/mat3x3.hpp>

#include "render/scene/scene.h"
#include "stone/solid/solid.h"

namespace culet {

/// A picture's point, pixels as in EyeRays.
struct PicturePoint {
    double x = 0, y = 0;
};

/// In the viewing frame x runs to the right of the picture, y down, and z along the line of sight
/// to the stone's middle, away from the camera.
struct StoneView {
    glm::dmat3 turn{1};   ///< from the stone's frame to the viewing frame
    Vec3 middle{0};       ///< the point of the stone that the others are about
    PicturePoint at;      ///< where it is in the picture
    double scale = 1;     ///< pixels per length there, across the line of sight
    double nearness = 0;  ///< one over its distance along the camera's axis; 0: orthographic
    PicturePoint sight;   ///< the principal point

    /// Focal length in pixels; 0 when orthographic.
    double focal_px() const { return nearness > 0 ? scale / nearness : 0; }
};

StoneView stone_view(const Camera& camera, const Vec3& middle);

/// With the size, lens and optics of `like`. An orthographic camera stands as far away as `like`.
Camera camera_of(const StoneView& view, const Camera& like);

/// From the stone: where the camera is, or (orthographic) the direction to it.
struct EyePlace {
    Vec3 place{0};
    bool parallel = false;
    bool sees(const Plane& plane) const {
        return parallel ? glm::dot(plane.normal, place) > 0 : height_above(plane, place) > 0;
    }
};
EyePlace eye_of(const StoneView& view);

/// What can change about a view while it is fitted: turns about the viewing frame's axes (applied
/// after `turn`), position, logarithms of scale and nearness, principal point. All 0: the view.
constexpr int k_view_unknowns = 9;
using ViewChange = std::array<double, k_view_unknowns>;
StoneView changed(const StoneView& view, const ViewChange& change);

/// A rotation by the vector `w` (its length is the angle).
glm::dmat3 rotation_by(const Vec3& w);

/// Angle of the rotation.
double angle_of(const glm::dmat3& rotation);

/// Picture points of points of the stone.
class Projection {
public:
    explicit Projection(const StoneView& view);
    PicturePoint operator()(const Vec3& point) const;

private:
    StoneView view_;
    glm::dmat3 from_stone_;
};

}  // namespace culet
