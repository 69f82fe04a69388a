#pragma once
// One picture of a mirror ball: what it shows in a direction, and how well.

#include <cstdint>
#include <glm/mat3x3.hpp>
#include <memory>
#include <vector>

#include "compare/light_probe/mirror_ball.h"
#include "compare/photo/photo.h"
#include "render/colour/colour.h"

namespace culet {

/// How far from the camera's direction the camera and who stands behind it may reach in the
/// reflection, radians: nothing within the first angle is used when another view shows it,
/// everything beyond the second.
struct PhotographerCone {
    double within = 0.175, beyond = 0.28;  // 10 and 16 degrees
};

struct BallView {
    std::shared_ptr<const Photo> picture;  ///< linear light
    MirrorBall ball;
    PhotographerCone photographer;
    glm::dmat3 world_from_camera{1.0};
    /// Pixels that are not to be used, 1 each (the reflex of a near light); none: all are used.
    std::shared_ptr<const std::vector<std::uint8_t>> left_out = nullptr;

    /// 0..1: ((1 + cos theta) / 2)^2, theta counted from the camera's direction, which is the
    /// density of the ball's picture: 1 in the middle, 0 at the rim, where the picture is pressed
    /// flat; next to none of the photographer, so that a view alone keeps what it shows there; 0 in
    /// the blind cone and the last three degrees before it, and where a pixel is left out.
    double quality(const Vec3& direction_in_camera) const;
};

/// Bilinear. `over` is the share of the pixels in use that are over-exposed.
struct SeenLight {
    Rgb rgb{};
    double over = 0;
};
SeenLight light_at(const Photo& picture, const PixelPlace& place);

/// What one view knows of all directions of the world: a lat-long map of mean radiance (of the
/// picture, not divided by the ball's reflectance) and of quality. Texels that the view does not
/// show have quality 0.
struct ViewMap {
    int width = 0, height = 0;
    std::vector<float> rgb;
    std::vector<float> quality;
    std::vector<float> over;  ///< share of the texel that is over-exposed
};
/// Each texel is the mean over directions so dense that no pixel is passed over.
ViewMap view_map(const BallView& view, int width);

}  // namespace culet
