#pragma once
// Finds a stone's pose in a photograph, draws the scene at its scale, compares, and calibrates on
// request.

#include <filesystem>
#include <optional>
#include <string>

#include "compare/calibration/calibrated_verdict.h"
#include "compare/pose/find_pose.h"
#include "compare/scores/compare.h"
#include "render/render.h"
#include "render/uncertainty/drawn_stones.h"

namespace culet {

struct SceneCompareOptions {
    CompareOptions compare;
    bool find_pose = true;  ///< false: the scene's camera is used as it is
    bool calibrate = false;
    /// Time budget of a calibrated comparison on two processors, in counted work
    /// (render/work/price.h). Limits the pictures' number and resolution. 0: no limit.
    double budget_seconds = 30;
    int draws = 8;  ///< at each facet error, at most; nulls have three times as many
    /// Largest size of the stone, pixels, in every draw of the calibration.
    double largest = 256;
    std::filesystem::path cache{};  ///< folder of calibrations; empty: no cache
    std::optional<Solid> start{};   ///< the mesh that the fit started from
    /// If given, `Comparison::within` says how much of the photograph is within this uncertainty,
    /// from `drawn_stones` random stones.
    std::optional<StoneUncertainty> uncertainty{};
    int drawn_stones = 100;
};

struct SceneComparison {
    Comparison comparison;  ///< with the calibrated verdict and reason, if there is one
    std::optional<CalibratedVerdict> calibrated;
    Scene scene;   ///< as drawn: the camera in the photograph's pose, at the compared size
    Photo render;  ///< of `scene`
    RenderStats stats;
    std::optional<FoundPose> pose;
    bool pose_used = false;
};

/// Throws InputError as `render` does and for a camera that does not see the stone; Interrupted.
SceneComparison compare_with_scene(const Photo& photo, const Scene& scene,
                                   const SceneCompareOptions& options = {},
                                   const Progress& progress = {});

}  // namespace culet
