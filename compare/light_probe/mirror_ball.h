#pragma once
// Maps between a mirror ball's pixels and the directions of the world.
//
// Camera frame: x to the right of the picture, y up, z from the scene towards the camera, a pinhole
// that looks along -z. Pixels: x to the right, y down, the centre of the first pixel at (0, 0).
// Lengths in radii of the ball. The surroundings are infinitely far away unless a function mentions
// a point.

#include <limits>
#include <optional>

#include "stone/solid/solid.h"

namespace culet {

struct BallCircle {
    double x = 0, y = 0, radius = 0;
};

struct PixelPlace {
    double x = 0, y = 0;
};

/// Geometry of one view. Off the picture's middle a ball's outline is an ellipse; this is the ball
/// whose rays at the given circle best fit a cone about its centre.
class MirrorBall {
public:
    /// `distance`: camera to ball centre in ball radii (over 1; infinity: telecentric), which gives
    /// the focal length. `principal`: where the camera's axis meets the picture; its middle, unless
    /// cropped.
    static MirrorBall at_distance(const BallCircle& circle, const PixelPlace& principal,
                                  double distance);
    /// Focal length in pixels; the distance follows from the circle.
    static MirrorBall with_focal_length(const BallCircle& circle, const PixelPlace& principal,
                                        double focal_px);

    /// Unit direction from which a pixel's light comes, exact for any camera distance. Nothing
    /// beside the ball.
    std::optional<Vec3> direction_of(const PixelPlace& place) const;
    /// With the point of reflection on the unit ball: near objects lie on this line.
    struct Reflection {
        Vec3 at, direction;
    };
    std::optional<Reflection> reflection_at(const PixelPlace& place) const;
    /// The pixel that shows a direction; nothing in the blind cone behind the ball.
    std::optional<PixelPlace> place_of(const Vec3& direction) const;

    /// The pixel that shows the point `at / nearness`, in the camera's frame from the ball's
    /// centre; nearness 0: the direction `at`. Nothing in the blind cone.
    std::optional<PixelPlace> place_of_point(const Vec3& at, double nearness) const;

    /// From the camera, in ball radii, in its frame.
    const Vec3& centre() const { return centre_; }
    /// Unit.
    const Vec3& towards_camera() const { return towards_camera_; }
    double distance() const { return distance_; }
    double focal_px() const { return focal_px_; }
    const BallCircle& circle() const { return circle_; }
    /// Half-angle of the cone that the ball hides: asin(1 / distance).
    double blind_half_angle() const;
    /// Solid angle of one pixel at the ball's middle, steradians.
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
