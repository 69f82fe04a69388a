#pragma once
// Which ways of drawing a scene a study tries.

#include <string>
#include <vector>

#include "compare/study/study_ground.h"
#include "render/render.h"

namespace culet {

struct StudyCandidate {
    std::string sweep, setting;
    RenderSettings settings;
    bool automatic = false;
    bool needed = false;  ///< drawn whatever the budget says
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

}  // namespace culet
