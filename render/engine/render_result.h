#pragma once
// A picture, and what was left out of it.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "render/engine/scene_plan.h"
#include "render/image/picture.h"
#include "render/scene/engine_name.h"
#include "render/setup/optical_setup.h"

namespace culet {

/// How a finished picture compares with the truth: the reference with everything on at some pixels
/// of the stone. Errors as in scene_plan.h.
struct Verification {
    int pixels = 0, samples = 0;
    double difference = 0;                ///< to the truth as drawn
    double spread = 0;                    ///< standard error of it, as of pixels chosen at random
    double noise = 0;                     ///< what the truth's few rays are off by
    double measured = 0;                  ///< the difference less the noise
    double delta_e = 0;                   ///< CIEDE2000, with the noise in it
    double bound = 0, bound_delta_e = 0;  ///< what the picture says of itself
    double seconds = 0;

    /// The bound is not below what was measured, as far as that is certain.
    bool holds() const { return measured - 3 * spread - noise <= bound; }
};

struct RenderStats {
    std::string engine = k_reference_engine;
    int depth = 0;  ///< faces on the longest path that brought light
    std::vector<EffectDecision> effects;
    std::vector<double> wavelengths_nm;
    double mean_radiance = 0;  ///< of the stone's pixels, luminance
    /// Mean weight over the stone's pixels of what paths were left at the depth limit, and of paths
    /// cut for their small weight.
    double remainder = 0, cut = 0, absorbed = 0;
    /// (remainder + cut) x brightest light / mean radiance: the picture's relative error is below
    /// this on average over the stone, beside sampling and effects switched off.
    double error_bound = 0;
    /// Crystals, whose smallest paths are chosen at random: root mean square over the stone's
    /// pixels of the standard error of a pixel, relative to the mean. Each choice is made twice,
    /// independently, and the differences tell it without bias.
    double standard_error = 0;
    /// Reference: mean over the stone's pixels of about what their few rays are off by, relative to
    /// the mean: half the difference between every other ray and the rest.
    double sampling_error = 0;
    /// What was decided, where the scene left it open; then `error_bound` is that of the plan with
    /// what the picture shows of its sampling, or of the beams.
    std::optional<ScenePlan> plan;
    std::optional<Verification> verification;  ///< where asked for
    /// Where the tolerance was what the work allowed: the one that was chosen.
    std::optional<double> allowed_tolerance;
    /// Largest |sum of powers - 1| met at a crystal's face before it was put right.
    double worst_imbalance = 0;
    /// Beams: mean of |difference to the reference| over pixels of the stone, relative to the mean,
    /// measured at `checked_pixels` of them, with three standard errors; part of `error_bound`.
    double engine_error = 0;
    int checked_pixels = 0;
    long long beams = 0;     ///< of all wavelengths and pupil positions
    long long retraced = 0;  ///< rays that did not meet their beam's facets, and were traced anew
    double lost_area = 0;    ///< that no beam covers, as a share of the stone's
    std::vector<std::string> notes;  ///< what a person should know about this picture
    long long rays = 0;              ///< eye rays x bands that met the stone
    double seconds_setup = 0, seconds_build = 0, seconds_shade = 0, seconds_check = 0;
};

struct RenderResult {
    Picture picture;
    RenderStats stats;
};

/// Told of a picture that is nearer to the truth than those before.
using PictureSink = std::function<void(const RenderResult&)>;

}  // namespace culet
