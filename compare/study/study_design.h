#pragma once
// The settings that a study tries.

#include <string>
#include <vector>

#include "compare/study/studied_scene.h"
#include "render/render.h"

namespace culet {

struct StudyCandidate {
    std::string sweep, setting;
    RenderSettings settings;
    bool automatic = false;
    bool needed = false;  ///< drawn regardless of the budget
};

/// The reference's settings except samples and seed: all effects on, nothing left to a plan.
/// `nodes`: number of wavelengths, if a spectrum is needed.
RenderSettings exact_settings(const Scene& scene, double tolerance, int nodes);

/// Automatic settings at each tolerance, the engines, and one setting varied at a time about the
/// scene's tolerance; most informative first.
std::vector<StudyCandidate> study_design(const StudiedScene& studied);

/// Cheaper in one respect each: shallower, fewer wavelengths, one effect less, ...
std::vector<StudyCandidate> cheaper_neighbours(const StudiedScene& studied,
                                               const RenderSettings& settings,
                                               const RenderStats& drawn);

}  // namespace culet
