#pragma once
// What a picture of a mirror ball shows in a direction, and with what quality.

#include <cstdint>
#include <glm/mat3x3.hpp>
#include <memory>
#include <vector>

#include "compare/light_probe/mirror_ball.h"
#include "compare/photo/photo.h"
#include "render/colour/colour.h"

namespace culet {

/// Angles from the camera's direction, radians, where camera and photographer may be reflected.
/// Inside `within` nothing is used if another view shows it; outside `beyond` everything is.
struct PhotographerCone {
    double within = 0.175, beyond = 0.28;  // 10 and 16 degrees
};

struct BallView {
    std::shared_ptr<const Photo> picture;  ///< linear light
    MirrorBall ball;
    PhotographerCone photographer;
    glm::dmat3 world_from_camera{1.0};
    /// 1 for each unused pixel (the reflex of a near light); null: none.
    std::shared_ptr<const std::vector<std::uint8_t>> left_out = nullptr;

    /// 0..1: the density of the ball's picture, ((1 + cos theta) / 2)^2 with theta from the
    /// camera's direction: 1 in the middle, 0 at the compressed rim. Nearly 0 where the
    /// photographer may be, so that a single view keeps what it shows there. 0 in the blind cone,
    /// within three degrees of it, and at left-out pixels.
    double quality(const Vec3& direction_in_camera) const;
};

/// `over`: share of the used pixels that are over-exposed.
struct SeenLight {
    Rgb rgb{};
    double over = 0;
};
SeenLight light_at(const Photo& picture, const PixelPlace& place);

/// What one view shows of all directions: a lat-long map of mean radiance (not divided by the
/// ball's reflectance) and of quality, 0 for texels that it does not show.
struct ViewMap {
    int width = 0, height = 0;
    std::vector<float> rgb;
    std::vector<float> quality;
    std::vector<float> over;  ///< share of the texel that is over-exposed
};
/// Texels are means over directions dense enough to hit every pixel.
ViewMap view_map(const BallView& view, int width);

}  // namespace culet
