#pragma once
// The result of comparing a render with a photograph, as plain data.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "compare/photo/photo.h"
#include "compare/scores/score.h"

namespace culet {

/// Positions are pixels of the given pictures, centre of the first pixel at (0, 0), y down.
struct Registration {
    double residual_px = 0;  ///< root mean square distance between the outlines, photo pixels
    double worst_px = 0;     ///< 95 % quantile of that distance
    double iou = 0;          ///< overlap of the silhouettes: intersection over union
    double scale = 1;        ///< render pixels per photo pixel
    double turn_deg = 0;     ///< from photo to render, clockwise as seen
    bool turn_known = true;  ///< false: the outlines are round, and the turn stays 0
    std::array<double, 2> shift_px{};   ///< from the stone's centre in the photo to the render's
    std::array<double, 2> centre_px{};  ///< of the stone in the photo
    double photo_diameter_px = 0, render_diameter_px = 0;  ///< of the circles of equal area
    std::string photo_outline, render_outline;  ///< origin: "mask", "coverage", "background"
    std::vector<std::string> warnings;
};

/// One value for each pixel, rows from the top; NaN where undefined.
struct PixelMap {
    int width = 0, height = 0;
    std::vector<float> values;
};

/// For the report: everything in the frame of the photo's close-up.
struct ComparedPictures {
    Photo photo, render;                     ///< render with the gain; empty when refused early
    double white = 1;                        ///< linear value shown as white
    PixelMap mask;                           ///< 1 where compared, NaN elsewhere
    PixelMap photo_outline, render_outline;  ///< 1 inside, NaN outside
    PixelMap luminance_difference;           ///< render - photo, encoded luminance, -1..1
    PixelMap colour_difference;              ///< CIEDE2000
    PixelMap visible_difference;             ///< FLIP, 0..1
    PixelMap similarity;                     ///< local SSIM
};

/// Counts of bright reflexes, see reflexes.h.
struct ReflexCount {
    int in_photo = 0, in_render = 0, matched = 0;
    std::optional<double> displacement;  ///< median, in diameters
    /// Matched and coloured in the photo; and with the same hue in the render.
    int coloured = 0, same_hue = 0;
    /// All of them, the photo's first, for the report's picture.
    struct Mark {
        std::array<double, 2> at_px{};  ///< in the frame of the photo's close-up
        double radius_px = 0;           ///< of the circle of equal area
        bool of_photo = true;
        int partner = -1;  ///< index in the other picture; -1: not found there
    };
    std::vector<Mark> marks;
};

/// "37 of 42 reflexes found, 0.4 % of the diameter apart; 9 of 11 coloured ones of one hue"
std::string sentence_of(const ReflexCount& reflexes);

/// The share of a photograph within the luminance bands of stones drawn from the fit's uncertainty.
/// For one of those stones it would be 0.683 and 0.954.
struct WithinReadings {
    double within_one = 0, within_two = 0;  ///< share of the compared pixels within 1, 2 sigma
    int pixels = 0;                         ///< compared, and not clipped by the camera
    PixelMap map;                           ///< 0 within one sigma, 0.5 within two, 1 outside
};

struct Comparison {
    Verdict verdict = Verdict::refused;
    std::string reason;  ///< the verdict in one sentence
    Registration registration;
    std::array<double, 3> gain{1, 1, 1};  ///< factors on the render, R G B
    double saturated = 0;                 ///< share of compared pixels that the camera clipped
    int compared_pixels = 0;
    std::vector<Score> scores;
    bool geometry_only = false;  ///< the photograph cannot serve for photometry
    ReflexCount reflexes;
    /// Mean luminance of the compared pixels; 1 is the white level. The render's is with the gain.
    double photo_light = 0, render_light = 0;
    int null_draws = 0;
    std::string null_note;
    /// Standard deviation in pixels of the Gaussian that made the render as soft as the photograph,
    /// in a calibrated comparison; otherwise 0.
    double render_blur_px = 0;
    std::vector<std::string> notes;
    std::string pose_note;  ///< for a comparison with a scene: where its view was sought, and why
    bool simulated = false;
    std::uint64_t seed = 1;
    std::optional<WithinReadings> within;  ///< for a render with bands (Photo::bands)
    ComparedPictures pictures;

    /// False: the registration was refused.
    bool usable() const { return verdict != Verdict::refused; }
};

struct CompareOptions {
    bool simulated = false;  ///< the photograph is itself computed, which every output says
    std::uint64_t seed = 1;  ///< for the null's draws
    int null_draws = 24;     ///< at least 20
    int threads = 0;         ///< 0: all processors; the result does not depend on it
};

/// The verdict is a proposal, not validated. `match`: zncc is at least `k_match_z` standard
/// deviations above its null and at least `k_match_zncc`, about what random facet errors of half a
/// degree leave of a brilliant's pattern. `partial`: from `k_partial_z` on, if no draw was as good.
/// It tells a pattern from itself rotated, but not a stone from another of the same cut.
constexpr double k_match_z = 5, k_partial_z = 2, k_match_zncc = 0.8;
/// The same for CW-SSIM, which decides for photographs that cannot serve for photometry.
constexpr double k_match_cw_ssim = 0.55;

}  // namespace culet
