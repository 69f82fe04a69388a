#pragma once
// Which parts of the surroundings a stone shows in each pixel. Private to the room, because it
// exposes OpenCV.

#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "fit/silhouettes/turning_camera.h"
#include "refine/spin/stone_attitude.h"
#include "stone/material/material.h"

namespace culet {

/// A part of the sphere of directions, which stands still before the camera. Radians; azimuths
/// count counter-clockwise from above, from the camera's.
struct LightZone {
    std::string name;
    double from_elevation = 0, to_elevation = 0, from_azimuth = 0, to_azimuth = 0;
};

/// A cap of `k_camera_cap` about the direction to the camera is the last zone, "camera".
inline constexpr double k_camera_cap = 0.4363;
const std::vector<LightZone>& light_zones();

/// A frame as the camera has it, its pixels taken together in squares of `shrink` pixels.
struct ShrunkFrame {
    const LevelPicture* picture = nullptr;
    Projection projection{};
    int shrink = 1;
    int rays = 4;  ///< through each pixel; a square number
};

struct ZoneShares {
    cv::Mat stone;              ///< CV_8U: 255 where a pixel shows nothing but the stone
    std::vector<float> shares;  ///< by pixel, then by zone; the light of a pixel is their sum
                                ///< weighted with the zones' radiances
};

/// Of a clear stone in the light of the sodium lines, upright as in the projection, by its light
/// paths (render/raytable). The result does not depend on `threads`.
ZoneShares zone_shares(const Solid& solid, const Material& material, const TurningCamera& camera,
                       const ShrunkFrame& frame, int threads);

/// Linear light, CV_32FC3, R G B.
cv::Mat shrunk_picture(const ShrunkFrame& frame);

}  // namespace culet
