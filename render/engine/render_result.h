#pragma once
// A picture and its statistics.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "render/engine/scene_plan.h"
#include "render/image/picture.h"
#include "render/scene/engine_name.h"
#include "render/setup/optical_setup.h"

namespace culet {

/// Comparison of a picture with the reference (everything on) at some pixels of the stone. Errors
/// as in scene_plan.h.
struct Verification {
    int pixels = 0, samples = 0;
    double difference = 0;                ///< from the reference as drawn
    double standard_error = 0;            ///< its standard error
    double noise = 0;                     ///< error of the reference's few rays
    double measured = 0;                  ///< the difference less the noise
    double delta_e = 0;                   ///< CIEDE2000, including the noise
    double bound = 0, bound_delta_e = 0;  ///< claimed by the picture
    double seconds = 0;

    /// False if the measured error is clearly above the claimed bound.
    bool holds() const { return measured - 3 * standard_error - noise <= bound; }
};

struct RenderStats {
    std::string engine = k_reference_engine;
    int depth = 0;  ///< faces on the longest path that carried light
    std::vector<EffectDecision> effects;
    std::vector<double> wavelengths_nm;
    double mean_radiance = 0;  ///< luminance, over the stone's pixels
    /// Mean weight over the stone's pixels: left at the depth limit; of paths cut for their small
    /// weight; absorbed.
    double remainder = 0, cut = 0, absorbed = 0;
    /// (remainder + cut) x brightest light / mean radiance: bounds the mean relative error over the
    /// stone, apart from sampling and effects switched off.
    double error_bound = 0;
    /// Crystals, whose smallest paths are chosen at random: root mean square standard error of a
    /// pixel, relative to the mean. Unbiased: each choice is made twice, independently.
    double standard_error = 0;
    /// Reference: mean error of the pixels due to few rays, relative to the mean radiance; half the
    /// difference between every other ray and the rest.
    double sampling_error = 0;
    /// Set if the scene left anything open. `error_bound` is then the plan's, with the measured
    /// error of sampling or beams.
    std::optional<ScenePlan> plan;
    std::optional<Verification> verification;  ///< if asked for
    /// The tolerance that the allowed work sufficed for.
    std::optional<double> allowed_tolerance;
    /// Largest |sum of powers - 1| at a crystal's face before it was corrected.
    double worst_imbalance = 0;
    /// Beams: mean |difference| from the reference, relative to the mean radiance, plus three
    /// standard errors, measured at `checked_pixels` pixels. Part of `error_bound`.
    double engine_error = 0;
    int checked_pixels = 0;
    long long beams = 0;     ///< over all wavelengths and pupil positions
    long long retraced = 0;  ///< rays that did not meet their beam's facets and were traced again
    double lost_area = 0;    ///< share of the stone's area that no beam covers
    std::vector<std::string> notes;  ///< for the user
    long long rays = 0;              ///< eye rays x bands that met the stone
    double seconds_setup = 0, seconds_build = 0, seconds_shade = 0, seconds_check = 0;
};

struct RenderResult {
    Picture picture;
    RenderStats stats;
};

/// Receives each picture that is closer to the truth than those before.
using PictureSink = std::function<void(const RenderResult&)>;

}  // namespace culet
