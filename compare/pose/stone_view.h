#pragma once
// A camera relative to the stone: rotation, place in the picture, size. Unlike position, look_at
// and fov, these unknowns are almost uncorrelated, and an orthographic camera is no special case.

#include <array>
#include <glm/mat3x3.hpp>

#include "render/scene/scene.h"
#include "stone/solid/solid.h"

namespace culet {

/// Pixels as in EyeRays.
struct PicturePoint {
    double x = 0, y = 0;
};

/// Viewing frame: x to the right of the picture, y down, z along the line of sight to the stone's
/// middle, away from the camera.
struct StoneView {
    glm::dmat3 turn{1};   ///< from the stone's frame to the viewing frame
    Vec3 middle{0};       ///< reference point of the stone for the members below
    PicturePoint at;      ///< where `middle` is in the picture
    double scale = 1;     ///< pixels per length at `middle`, across the line of sight
    double nearness = 0;  ///< 1 / distance along the camera's axis; 0: orthographic
    PicturePoint sight;   ///< principal point

    /// Focal length in pixels; 0 when orthographic.
    double focal_px() const { return nearness > 0 ? scale / nearness : 0; }
};

StoneView stone_view(const Camera& camera, const Vec3& middle);

/// With size, lens and optics of `like`; for an orthographic camera also its distance.
Camera camera_of(const StoneView& view, const Camera& like);

/// In the stone's frame: the camera's position or (orthographic) direction.
struct EyePlace {
    Vec3 place{0};
    bool parallel = false;
    bool sees(const Plane& plane) const {
        return parallel ? glm::dot(plane.normal, place) > 0 : height_above(plane, place) > 0;
    }
};
EyePlace eye_of(const StoneView& view);

/// Changes of a view while it is fitted: rotations about the viewing frame's axes (applied after
/// `turn`), place, logarithms of scale and nearness, principal point. All 0: no change.
constexpr int k_view_unknowns = 9;
using ViewChange = std::array<double, k_view_unknowns>;
StoneView changed(const StoneView& view, const ViewChange& change);

/// Rotation by the vector `w`, whose length is the angle.
glm::dmat3 rotation_by(const Vec3& w);

double angle_of(const glm::dmat3& rotation);

class Projection {
public:
    explicit Projection(const StoneView& view);
    PicturePoint operator()(const Vec3& point) const;

private:
    StoneView view_;
    glm::dmat3 from_stone_;
};

}  // namespace culet
