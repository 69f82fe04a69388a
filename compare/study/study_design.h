#pragma once
// Which ways of drawing a scene a study tries.

#include <string>
#include <vector>

#include "render/render.h"

namespace culet {

struct StudyCandidate {
    std::string sweep, setting;
    RenderSettings settings;
    bool automatic = false;
    bool needed = false;  ///< drawn whatever the budget says
};

/// What the design needs to know of a scene.
struct StudyGround {
    Scene scene;                     ///< at the studied size
    RenderStats exact;               ///< of the reference: effects, wavelengths, depth
    bool beams = true;               ///< they can draw it
    double tolerance = 0.01;         ///< that the sweeps are about: the scene's own
    std::vector<double> tolerances;  ///< falling
};

/// Everything on, and nothing left open for a plan: what the reference is drawn with, but for
/// samples and seed. `nodes`: wavelengths, where a spectrum is called for.
RenderSettings exact_settings(const Scene& scene, double tolerance, int nodes);

/// Automatic settings at each tolerance, engines, and one thing varied at a time about the
/// scene's tolerance; the most telling first.
std::vector<StudyCandidate> study_design(const StudyGround& ground);

/// One thing cheaper each: shallower, fewer wavelengths, an effect less, ...
std::vector<StudyCandidate> cheaper_neighbours(const StudyGround& ground,
                                               const RenderSettings& settings,
                                               const RenderStats& drawn);

/// The same for settings that draw the same: effects that are not called for do not count.
std::string key_of(const StudyGround& ground, const RenderSettings& settings);

/// "beams, 15 wavelengths, depth 8, tolerance 0.01, without dispersion"
std::string words_of(const StudyGround& ground, const RenderSettings& settings);

/// The effects' names that these settings switch off although the reference has them on.
std::vector<std::string> effects_left_out(const StudyGround& ground,
                                          const RenderSettings& settings);

}  // namespace culet
