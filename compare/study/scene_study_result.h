#pragma once
// What a study of a scene was asked and what it found, as plain data.

#include <optional>
#include <string>
#include <vector>

#include "compare/scores/compare.h"
#include "render/render.h"

namespace culet {

struct SceneStudyOptions {
    /// The longer side of the pictures, pixels; 0: from 64 to 256, as large as a reference of 64
    /// rays a pixel is expected to be within its share of the budget.
    int size = 0;
    /// Seconds of processor time; 0: no limit. The reference takes up to 40 % of it, the
    /// design 25 %, the search 20 %, repeated timing the rest. One that is too small is overrun:
    /// the automatic settings and each engine are drawn at least once.
    double budget_seconds = 120;
    std::vector<double> tolerances{0.1, 0.03, 0.01, 0.003};
    int runs = 5;  ///< of each setting that may be on the front, for the median of its time
};

/// Errors of one picture over the stone's pixels.
struct PictureError {
    /// Mean absolute difference of R, G and B over their mean: what `tolerance` speaks of
    /// (render/engine/scene_plan.h).
    double mean = 0;
    double rmse = 0;  ///< root mean square, likewise
    /// Of the encoded picture, peak at white, decibel; nothing for equal pictures.
    std::optional<double> psnr;
    double delta_e_mean = 0, delta_e_95 = 0;  ///< CIEDE2000
    double flip = 0;
};

/// Seconds: median, least and most of `runs`.
struct StudyTime {
    double median = 0, least = 0, most = 0;
};

/// One way of drawing the scene, and what came of it.
struct StudiedRender {
    int id = 0;
    std::string sweep;    ///< what is varied: "tolerance", "depth", "search", ...
    std::string setting;  ///< "8", "without dispersion", ...
    std::string words;    ///< all of it: "beams, depth 8, tolerance 0.01, without dispersion"
    bool automatic = false;
    RenderSettings settings;  ///< as asked
    RenderSettings settled;   ///< as drawn; automatic: what the plan made of them
    RenderStats stats;        ///< of the drawing
    PictureError error;
    /// `error.mean`, or what the reference itself may be off by where that is more.
    double claimed_error = 0;
    bool at_noise = false;  ///< the error is less than twice what the reference is off by
    int runs = 0;
    /// Of the drawing, without the beams' check against the reference renderer; automatic: with its
    /// planning, and with the beams and their check where these did not prove near enough.
    StudyTime cpu, wall;
    double checked_cpu = 0;  ///< automatic: all that `render` does, the check too
    bool on_front = false;
    Picture picture;      ///< of those on the front
    PixelMap difference;  ///< likewise; luminance relative to the mean
};

struct StudyReference {
    int samples = 0;  ///< rays a pixel of both halves together
    /// Beside them, of few wavelengths and short paths: what the exact ones differ from these along
    /// the same rays is added to the mean of all. 0: none, where they would save little time.
    int rough_samples = 0;
    double tolerance = 0;
    RenderStats stats;   ///< of the first half
    PictureError noise;  ///< of the mean of the two, by their difference
    double cpu_seconds = 0;
    std::string ended;  ///< why there are no more rays
    Picture picture;
    int stone_pixels = 0;
    double mean_radiance = 0, white = 0;
};

/// The cheapest way found to meet a tolerance, and what the automatic settings make of it.
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
    /// Ids, quickest first; each is nearer to the truth by 2 % than any quicker one.
    std::vector<int> front;
    std::vector<StudyAdvice> advice;
    std::vector<std::string> left_out;  ///< settings not drawn, and why
    std::vector<std::string> notes;
    double cpu_seconds = 0;
    SceneStudyOptions options;
    RenderSettings asked;  ///< by the scene

    /// The reference can judge the scene's own tolerance, and the automatic settings were drawn.
    bool usable() const;
    const StudiedRender& render(int id) const { return renders[static_cast<std::size_t>(id)]; }
};

}  // namespace culet
