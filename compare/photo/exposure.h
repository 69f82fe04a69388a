#pragma once
// What a camera notes about a shot, and how much light that let in.

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace culet {

/// From a file's EXIF data (EXIF 2.3, CIPA DC-008); what it does not say is 0 or empty.
struct ShotData {
    double seconds = 0;  ///< from ShutterSpeedValue (2^-Tv), which is not rounded as 1/30 is
    double f_number = 0;
    double iso = 0;
    double focal_mm = 0;
    double focal_35mm = 0;  ///< the focal length with the same diagonal view on 36 x 24 mm
    std::string camera;     ///< make and model
    /// Why the values do not stand for light, as the file itself says ("HDR by the phone", ...);
    /// empty: it does not say so.
    std::string processed;
    bool known() const { return seconds > 0 || iso > 0 || !camera.empty(); }
};

/// Of a JPEG's bytes, or of a TIFF's (raw files among them). Never throws: damaged data count as
/// none. The bytes are held against their own lengths by libexif.
ShotData shot_data(std::string_view bytes);

/// Light per unit of radiance that reached the file, relative to 1 s at f/1 and ISO 100:
/// t ISO / (100 N^2). Unknown aperture or ISO count as alike in a series. Nothing without a time.
std::optional<double> exposure_of(const ShotData& shot);

/// The focal length in pixels of a picture `diagonal_px` across corners; 0: not known.
double focal_px_of(const ShotData& shot, double diagonal_px);

/// "1/125 s, f/8, ISO 100"
std::string text_of(const ShotData& shot);

/// An exposure as people write it: `1/125`, `0.008`, `0.008s`, `1/125 s`, `-2EV` (relative).
/// Throws InputError.
double parse_exposure(const std::string& text);

}  // namespace culet
