#pragma once
// What a camera records about a shot, and its exposure.

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace culet {

/// From EXIF data (EXIF 2.3, CIPA DC-008); missing values are 0 or empty.
struct ShotData {
    double seconds = 0;  ///< from ShutterSpeedValue (2^-Tv), which is not rounded as 1/30 is
    double f_number = 0;
    double iso = 0;
    double focal_mm = 0;
    double focal_35mm = 0;  ///< equivalent on 36 x 24 mm, for the same diagonal view
    std::string camera;     ///< make and model
    /// Why the values are not linear light, from the file ("HDR by the phone", ...); otherwise
    /// empty.
    std::string processed;
    bool known() const { return seconds > 0 || iso > 0 || !camera.empty(); }
};

/// From the bytes of a JPEG or a TIFF (including raw files). Never throws: damaged data count as
/// none. libexif checks the lengths.
ShotData shot_data(std::string_view bytes);

/// Exposure relative to 1 s at f/1 and ISO 100: t ISO / (100 N^2). Unknown aperture or ISO is
/// assumed constant in a series. Nothing without a time.
std::optional<double> exposure_of(const ShotData& shot);

/// Focal length in pixels for a picture of diagonal `diagonal_px`; 0: unknown.
double focal_px_of(const ShotData& shot, double diagonal_px);

/// "1/125 s, f/8, ISO 100"
std::string text_of(const ShotData& shot);

/// From `1/125`, `0.008`, `0.008s`, `1/125 s`, `-2EV` (relative). Throws InputError.
double parse_exposure(const std::string& text);

}  // namespace culet
