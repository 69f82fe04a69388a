#pragma once
// Photographs of stones from a known camera: drawn by beams, with facets that differ from the
// model's, a lens that blurs, and a camera with photon noise and 8 bits.

#include <cstdint>
#include <random>
#include <string>

#include "compare/photo/photo.h"
#include "render/image/picture.h"
#include "render/scene/scene.h"

namespace culet::synthetic {

/// Tilts each facet about a random axis in it, through its middle, by an angle from N(0, sigma).
Solid tilted_facets(const Solid& solid, double sigma, std::mt19937_64& random);

struct CameraFaults {
    double blur_px = 0.7;      ///< one sigma of the lens
    double full_well = 12000;  ///< electrons at the clipping level
    double read_noise = 6;
    double exposure_share = 0.98;  ///< of the stone's pixels that stay below clipping
    bool eight_bit = true;         ///< sRGB
    int jpeg_quality = 0;          ///< of an 8-bit picture written as JPEG; 0: none
};

Photo photographed(const Picture& picture, const CameraFaults& faults, std::mt19937_64& random);

Photo cropped(const Photo& photo, int left, int top, int width, int height);

Photo mirrored(const Photo& photo);

/// "windows", "dome", "ring", "overcast": lights in the upper half, so that the background is
/// uniform.
Lights named_lights(const std::string& name);

/// A camera at `tilt` from the table's normal towards `azimuth`, turned by `roll` about its line of
/// sight. The stone fills `share` of the picture and is up to 5 % off centre. `diameters`: its
/// distance; 0: orthographic.
struct Standpoint {
    double tilt = 0, azimuth = 0, roll = 0, share = 0.75, diameters = 12;
    double off_x = 0, off_y = 0;  ///< of the picture's width
    int size = 400;
};
Camera camera_at(const Solid& solid, const Standpoint& place);

/// Turns the camera about the stone by `angle` about a random axis, and multiplies its distance or
/// width by `scale`.
Camera disturbed(const Camera& camera, const Solid& solid, double angle, double scale,
                 std::mt19937_64& random);

}  // namespace culet::synthetic
