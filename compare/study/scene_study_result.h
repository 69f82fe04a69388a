#pragma once
// Input and results of a scene study, as plain data.

#include <optional>
#include <string>
#include <vector>

#include "compare/scores/compare.h"
#include "render/render.h"

namespace culet {

struct SceneStudyOptions {
    /// Longer side of the pictures, pixels. 0: 64 to 256, the largest whose reference of 64 rays a
    /// pixel should fit into its share of the budget.
    int size = 0;
    /// Seconds of processor time; 0: no limit. The reference takes up to 40 %, the design 25 %, the
    /// search 20 %, and repeated timing the rest. Too small a budget is exceeded, because the
    /// automatic settings and each engine are drawn at least once.
    double budget_seconds = 120;
    std::vector<double> tolerances{0.1, 0.03, 0.01, 0.003};
    int runs = 5;  ///< of each setting that may be on the front, for its median time
};

/// Errors of one picture over the stone's pixels.
struct PictureError {
    /// Mean absolute difference of R, G and B over their mean: what `tolerance` limits
    /// (render/engine/scene_plan.h).
    double mean = 0;
    double rmse = 0;  ///< root mean square difference, likewise
    /// Of the encoded picture, peak at white, decibel; nothing for equal pictures.
    std::optional<double> psnr;
    double delta_e_mean = 0, delta_e_95 = 0;  ///< CIEDE2000
    double flip = 0;
};

/// Seconds: median, least and most of `runs`.
struct StudyTime {
    double median = 0, least = 0, most = 0;
};

struct StudiedRender {
    int id = 0;
    std::string sweep;    ///< what is varied: "tolerance", "depth", "search", ...
    std::string setting;  ///< "8", "without dispersion", ...
    std::string words;    ///< complete: "beams, depth 8, tolerance 0.01, without dispersion"
    bool automatic = false;
    RenderSettings settings;  ///< as requested
    RenderSettings settled;   ///< as drawn; automatic: as completed by the plan
    RenderStats stats;        ///< of the drawing
    PictureError error;
    /// The larger of `error.mean` and the reference's own error.
    double claimed_error = 0;
    bool at_noise = false;  ///< the error is less than twice the reference's own
    int runs = 0;
    /// Without the beams' check against the reference renderer. Automatic: with the planning, and
    /// with the beams and their check if these were not accurate enough.
    StudyTime cpu, wall;
    double checked_cpu = 0;  ///< automatic: all that `render` does, with the check
    bool on_front = false;
    Picture picture;      ///< only of renders on the front
    PixelMap difference;  ///< likewise; luminance relative to the mean
};

struct StudyReference {
    int samples = 0;  ///< rays per pixel of both halves together
    /// Rays per pixel with few wavelengths and short paths, a control variate: their mean plus the
    /// mean difference of exact rays along the same paths. 0: none, where they would save little.
    int control_samples = 0;
    double tolerance = 0;
    RenderStats stats;   ///< of the first half
    PictureError noise;  ///< of the mean of the two, from their difference
    double cpu_seconds = 0;
    std::string ended;  ///< why no more rays were drawn
    Picture picture;
    int stone_pixels = 0;
    double mean_radiance = 0, white = 0;
};

/// The cheapest way found to meet a tolerance, beside the automatic settings.
struct StudyAdvice {
    double tolerance = 0;
    std::optional<int> cheapest, automatic;  ///< ids; automatic: drawn, whether it met it or not
    bool automatic_meets = false;
    std::optional<double> ratio;  ///< processor time, automatic over cheapest
    std::string words;
};

struct SceneStudy {
    std::string name;
    int width = 0, height = 0, scene_width = 0, scene_height = 0;
    StudyReference reference;
    std::vector<StudiedRender> renders;  ///< in the order drawn
    /// Ids, fastest first; each has an error at least 2 % smaller than any faster one.
    std::vector<int> front;
    std::vector<StudyAdvice> advice;
    std::vector<std::string> left_out;  ///< settings not drawn, and why
    std::vector<std::string> notes;
    double cpu_seconds = 0;
    SceneStudyOptions options;
    RenderSettings asked;  ///< by the scene

    /// The reference is accurate enough for the scene's tolerance, and the automatic settings were
    /// drawn.
    bool usable() const;
    const StudiedRender& render(int id) const { return renders[static_cast<std::size_t>(id)]; }
};

}  // namespace culet
