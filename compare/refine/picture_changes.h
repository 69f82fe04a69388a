#pragma once
// Derivatives of the stone's picture by its planes' moves and the set-up's angles, from sketches.

#include <opencv2/core/mat.hpp>
#include <vector>

#include "compare/calibration/stone_samples.h"
#include "compare/refine/set_up.h"
#include "stone/numbers/units.h"
#include "stone/progress/progress.h"

namespace culet {

/// Step of the differences, radians. Changes are linear up to about here; smaller ones drown in a
/// sketch's omissions.
constexpr double k_move_step = radians(0.15);

struct SketchedStone {
    const DraftRenderer& renderer;
    const StoneSamples& samples;
    const Solid& solid;
    SetUp set_up;
    Vec3 middle{0};      ///< centre of the set-up's rotations
    CameraModel camera;  ///< the photograph's
    double blur = 1;     ///< samples
};

/// At the samples under `mask`, for each plane's moves (three per facet), then each set-up angle:
/// the slope (per radian), and both sketches minus twice the middle one.
struct PictureChanges {
    std::vector<std::vector<double>> slopes, second_differences;
};
/// Throws Interrupted.
PictureChanges picture_changes(const SketchedStone& stone, const cv::Mat& mask, int threads,
                               const Progress& progress);

}  // namespace culet
