#pragma once
// Photographs of stones whose camera is known: drawn by beams, with facets that are not quite the
// model's, a lens that blurs, a camera that counts photons and writes 8 bits.

#include <cstdint>
#include <random>
#include <string>

#include "compare/photo/photo.h"
#include "render/image/picture.h"
#include "render/scene/scene.h"

namespace culet::synthetic {

/// Each facet tilted by an angle from N(0, sigma) about a random axis in it, through its middle.
Solid tilted_facets(const Solid& solid, double sigma, std::mt19937_64& random);

struct CameraFaults {
    double blur_px = 0.7;          ///< one sigma of the lens
    double full_well = 12000;      ///< electrons at the clipping level
    double read_noise = 6;         ///< electrons
    double exposure_share = 0.98;  ///< of the stone's pixels below clipping
    bool eight_bit = true;         ///< sRGB
    int jpeg_quality = 0;          ///< of an 8-bit picture that was written as JPEG; 0: it was not
};

/// What a camera makes of a picture in linear light.
Photo photographed(const Picture& picture, const CameraFaults& faults, std::mt19937_64& random);

/// The rectangle of a picture: what is left when it is cropped.
Photo cropped(const Photo& photo, int left, int top, int width, int height);

/// Turned left to right.
Photo mirrored(const Photo& photo);

/// "windows", "dome", "ring", "overcast": lights of the upper half, so that what is behind the
/// stone is one tone.
Lights named_lights(const std::string& name);

/// A camera `tilt` from the table's normal towards `azimuth`, turned by `roll` about its line of
/// sight; the stone fills `share` of the picture and is off its middle by up to 5 %. `diameters`:
/// its distance; 0: orthographic.
struct Standpoint {
    double tilt = 0, azimuth = 0, roll = 0, share = 0.75, diameters = 12;
    double off_x = 0, off_y = 0;  ///< of the picture's width
    int size = 400;
};
Camera camera_at(const Solid& solid, const Standpoint& place);

/// The camera turned about the stone by `angle` about a random axis, its distance or width changed
/// by the factor `scale`.
Camera disturbed(const Camera& camera, const Solid& solid, double angle, double scale,
                 std::mt19937_64& random);

}  // namespace culet::synthetic
