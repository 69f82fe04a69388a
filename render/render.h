#pragma once
// Front door of the room: a scene in, a picture out, and what was left out of it.

#include <string>
#include <vector>

#include "render/picture.h"
#include "render/plan.h"
#include "render/scene.h"
#include "stone/progress.h"

namespace culet {

struct RenderStats {
    std::string engine = "reference";
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
    /// Largest |sum of powers - 1| met at a crystal's face before it was put right.
    double worst_imbalance = 0;
    std::vector<std::string> notes;  ///< what a person should know about this picture
    long long rays = 0;              ///< eye rays x bands that met the stone
    double seconds_setup = 0, seconds_shade = 0;
};

struct RenderResult {
    Picture picture;
    RenderStats stats;
};

/// The exact reference renderer. Same scene and seed, same bytes, whatever the number of threads.
/// Throws InputError (stone not closed, camera inside the stone) and
/// Interrupted.
RenderResult render(const Scene& scene, const Progress& progress = {});

/// STATS.json (docs/rendering.md) as text.
std::string stats_json(const RenderStats& stats);

}  // namespace culet
