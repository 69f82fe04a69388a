#pragma once
// A picture as it comes from a camera or from the renderer, in linear light.

#include <filesystem>
#include <string>
#include <vector>

#include "compare/photo/exposure.h"

namespace culet {

/// Rows from the top, pixels from the left, three floats (R, G, B in sRGB primaries) a pixel.
struct Photo {
    int width = 0, height = 0;
    std::vector<float> rgb;  ///< linear light; finite, not negative
    /// 0..1 for each pixel: how much of it the stone covers; empty when the file has no alpha.
    std::vector<float> coverage;
    /// Painted by hand (`read_mask`), one value a pixel: over a half is the stone; empty: it is
    /// found in the picture.
    std::vector<float> mask;
    /// Likewise: over a half is left out of every comparison (dust, inclusions, a holder); empty:
    /// nothing is.
    std::vector<float> ignored;
    /// Linear value at which the camera clips: 1 for integer files; 0: it does not (EXR, HDR).
    double saturation = 0;
    /// One variance (of the linear value) a sample, from a merged series; empty: not known.
    std::vector<float> variance;
    /// 0..1 for each pixel: over-exposed in every exposure there was; empty: see `saturation`.
    std::vector<float> saturated;
    /// Of a render with its stone's uncertainty (render/image/picture.h, k_band_channels): four
    /// levels of the luminance a pixel; empty: not known.
    std::vector<float> bands;
    /// False: the values do not stand for light (a tone-mapped JPEG); shapes and places only.
    bool photometric = true;
    std::string not_photometric;  ///< why, in a few words; empty when `photometric`
    ShotData shot;                ///< what the camera noted (EXIF)
    std::size_t not_finite = 0;   ///< samples that were NaN or infinite in the file, now 0
    std::string encoding;         ///< for the record: "8-bit sRGB", "linear EXR", ...
    /// What was repaired on reading, assumed, or not followed; one line each.
    std::vector<std::string> notes;
};

/// Reads PNG, JPEG, TIFF, EXR, HDR, PFM (render/image/image_io.h: what the file says of its numbers
/// is followed or noted; without a word, integers are sRGB and floats are linear), or a camera's
/// raw file (raw_file.h). A JPEG is not photometric: cameras write them through a tone curve of
/// their own, phones through one that differs from place to place. Throws InputError for a file
/// that is missing, broken, or of more than `k_max_photo_pixels`. `mask`, `ignored`: files of
/// Photo::mask and Photo::ignored, these one upon the other; may be empty.
Photo read_photo(const std::filesystem::path& file, const std::filesystem::path& mask = {},
                 const std::vector<std::string>& ignored = {});

/// What the camera noted, without the picture. Throws InputError for a file that is missing or, a
/// raw file, broken.
ShotData read_shot_data(const std::filesystem::path& file);

constexpr double k_max_photo_pixels = 2e8;

/// Of a sample in the file: 8 or 16; 0 for floats.
int bits_of(const Photo& photo);

/// A hand-painted mask: white (over half) is stone. One value 0 or 1 a pixel.
/// Throws InputError when its size is not `width` x `height`.
std::vector<float> read_mask(const std::filesystem::path& file, int width, int height);

}  // namespace culet
