#pragma once
// A photograph against a scene: the stone's pose is found, the scene drawn at the photograph's
// scale, compared, and on request calibrated.

#include <filesystem>
#include <optional>
#include <string>

#include "compare/calibration/calibrated_verdict.h"
#include "compare/pose/find_pose.h"
#include "compare/scores/compare.h"
#include "render/render.h"
#include "render/uncertainty/drawn_stones.h"
#include "stone/numbers/units.h"

namespace culet {

/// A pose that is sure (99 %) to so much, radians, is taken as it is.
constexpr double k_sure_pose = radians(2.0);

struct SceneCompareOptions {
    CompareOptions compare;
    bool find_pose = true;  ///< false: the scene's camera stands where it says
    bool calibrate = false;
    /// Of two processors, in counted work (render/work/price.h), for all of a calibrated
    /// comparison: as fine and as many pictures are drawn as that allows. 0: no limit.
    double budget_seconds = 30;
    int draws = 8;  ///< at each facet error, at most; nulls have three times as many
    /// Pixels that the stone is across at most: every draw of the calibration is drawn at it.
    double largest = 256;
    std::filesystem::path cache{};  ///< folder of calibrations; empty: none is kept
    std::optional<Solid> start{};   ///< the mesh that the fit started from
    /// How sure the stone's facets are: then `Comparison::within` says how much of the photograph
    /// is within it, by so many drawn stones.
    std::optional<StoneUncertainty> uncertainty{};
    int drawn_stones = 100;
};

struct SceneComparison {
    Comparison comparison;  ///< where it is calibrated, with that verdict and its reason
    std::optional<CalibratedVerdict> calibrated;
    Scene scene;   ///< as drawn: camera at the photograph's pose and at the compared size
    Photo render;  ///< of it
    RenderStats stats;
    std::optional<FoundPose> pose;
    bool pose_used = false;
};

/// Throws InputError as `render` does and for a camera that does not see the stone; Interrupted.
SceneComparison compare_with_scene(const Photo& photo, const Scene& scene,
                                   const SceneCompareOptions& options = {},
                                   const Progress& progress = {});

}  // namespace culet
