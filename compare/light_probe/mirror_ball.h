#pragma once
// Which direction of the world a pixel of a mirror ball shows.
//
// Camera frame: x to the right of the picture, y up, z from the scene towards the camera; the
// camera is a pinhole that looks along -z. Pixels: x to the right, y down, the centre of the first
// pixel at (0, 0). Lengths in radii of the ball. What the ball reflects is far away
// unless a function speaks of a point.

#include <limits>
#include <optional>

#include "stone/solid/solid.h"

namespace culet {

/// The ball's outline in a picture, as a circle.
struct BallCircle {
    double x = 0, y = 0, radius = 0;
};

struct PixelPlace {
    double x = 0, y = 0;
};

/// Geometry of one view. The outline of a ball beside the picture's middle is an ellipse; the ball
/// is the one whose rays at the given circle lie best on a cone about its centre.
class MirrorBall {
public:
    /// The camera is `distance` ball radii away from the ball's centre (over 1; infinity: a
    /// telecentric picture); its focal length follows from the circle. `principal` is where the
    /// camera's axis meets the picture: its middle, unless it was cropped.
    static MirrorBall at_distance(const BallCircle& circle, const PixelPlace& principal,
                                  double distance);
    /// The camera's focal length in pixels is known; the distance follows from the circle.
    static MirrorBall with_focal_length(const BallCircle& circle, const PixelPlace& principal,
                                        double focal_px);

    /// Where the light of a pixel comes from: the unit direction after the reflection, exact for a
    /// finite distance; nothing beside the ball.
    std::optional<Vec3> direction_of(const PixelPlace& place) const;
    /// The same with where on the unit ball it was reflected, from the ball's centre: what is near
    /// lies on this line.
    struct Reflection {
        Vec3 at, direction;
    };
    std::optional<Reflection> reflection_at(const PixelPlace& place) const;
    /// The pixel that shows a direction; nothing in the blind cone behind the ball.
    std::optional<PixelPlace> place_of(const Vec3& direction) const;

    /// The pixel that shows a point of the camera's frame, from the ball's centre: the light that
    /// comes from `at / nearness`, so that nearness 0 is a direction. Nothing in the blind cone.
    std::optional<PixelPlace> place_of_point(const Vec3& at, double nearness) const;

    /// From the camera to the ball's centre, in its radii and the camera's frame.
    const Vec3& centre() const { return centre_; }
    /// Unit direction from the ball to the camera.
    const Vec3& towards_camera() const { return towards_camera_; }
    double distance() const { return distance_; }
    double focal_px() const { return focal_px_; }
    const BallCircle& circle() const { return circle_; }
    /// Half the angle of the cone that the ball hides: asin(1 / distance).
    double blind_half_angle() const;
    /// Solid angle that one pixel shows at the ball's middle, steradians.
    double solid_angle_per_pixel() const;

private:
    MirrorBall(const BallCircle& circle, const PixelPlace& principal, double focal_px,
               double distance);
    Vec3 ray(const PixelPlace& place) const;

    BallCircle circle_;
    PixelPlace principal_;
    double focal_px_ = 1, distance_ = 1;
    Vec3 towards_camera_{0, 0, 1}, centre_{0, 0, -1};
};

}  // namespace culet
