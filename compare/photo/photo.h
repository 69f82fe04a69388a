#pragma once
// A picture from a camera or the renderer, in linear light.

#include <filesystem>
#include <string>
#include <vector>

#include "compare/photo/exposure.h"

namespace culet {

/// Rows from the top, pixels from the left, three floats (R, G, B in sRGB primaries) per pixel.
struct Photo {
    int width = 0, height = 0;
    std::vector<float> rgb;  ///< linear light; finite, not negative
    /// The stone's share of each pixel, 0..1; empty when the file has no alpha.
    std::vector<float> coverage;
    /// Hand-painted (`read_mask`): over 0.5 is stone. Empty: find the stone in the picture.
    std::vector<float> mask;
    /// Likewise: over 0.5 is never compared (dust, inclusions, a holder). Empty: nothing.
    std::vector<float> ignored;
    /// Linear value at which the camera clips: 1 for integer files; 0 (EXR, HDR): none.
    double saturation = 0;
    /// Variance of each sample (linear), from a merged series; empty: unknown.
    std::vector<float> variance;
    /// 0..1: over-exposed in every exposure. Empty: see `saturation`.
    std::vector<float> saturated;
    /// Of a render with its stone's uncertainty (render/image/picture.h, k_band_channels): four
    /// luminance levels for each pixel.
    std::vector<float> bands;
    /// False: not linear light (a tone-mapped JPEG); only shapes and places count.
    bool photometric = true;
    std::string not_photometric;  ///< the reason in a few words; empty when `photometric`
    ShotData shot;                ///< what the camera recorded (EXIF)
    std::size_t not_finite = 0;   ///< samples that were NaN or infinite in the file, now 0
    std::string encoding;         ///< for the record: "8-bit sRGB", "linear EXR", ...
    /// What was repaired, assumed or ignored on reading; one line each.
    std::vector<std::string> notes;
};

/// Reads PNG, JPEG, TIFF, EXR, HDR, PFM, or a camera's raw file (raw_file.h). The file's encoding
/// is followed or noted (render/image/image_io.h); by default integers are sRGB and floats are
/// linear. JPEGs are not photometric, because cameras apply tone curves, and phones even local
/// ones. `mask`, `ignored`: files for Photo::mask and Photo::ignored (all combined); may be empty.
/// Throws InputError for a missing or broken file, or over `k_max_photo_pixels`.
Photo read_photo(const std::filesystem::path& file, const std::filesystem::path& mask = {},
                 const std::vector<std::string>& ignored = {});

/// Without the picture. Throws InputError for a missing file or a broken raw file.
ShotData read_shot_data(const std::filesystem::path& file);

constexpr double k_max_photo_pixels = 2e8;

/// Bits of a sample in the file: 8 or 16; 0 for floats.
int bits_of(const Photo& photo);

/// Reads a hand-painted mask: over 0.5 (white) is stone. One value 0 or 1 for each pixel. Throws
/// InputError when its size is not `width` x `height`.
std::vector<float> read_mask(const std::filesystem::path& file, int width, int height);

}  // namespace culet
