#pragma once
// How the stone's picture changes with the moves of its planes and the angles of its set-up, by
// sketches a little either way.

#include <opencv2/core/mat.hpp>
#include <vector>

#include "compare/calibration/stone_samples.h"
#include "compare/refine/set_up.h"
#include "stone/numbers/units.h"
#include "stone/progress/progress.h"

namespace culet {

/// By how much planes are moved either way, radians: changes are straight up to about there, and
/// smaller ones drown in what a sketch leaves out.
constexpr double k_move_step = radians(0.15);

/// What a sketch is made of.
struct SketchedStone {
    const DraftRenderer& renderer;
    const StoneSamples& samples;
    const Solid& solid;
    SetUp set_up;
    Vec3 middle{0};      ///< about which the set-up turns
    CameraModel camera;  ///< of the photograph
    double blur = 1;     ///< samples
};

/// Of the samples under `mask`: for each plane's moves, three a facet, then for each angle of the
/// set-up, what a unit changes (per radian), and both sketches less twice the one between.
struct PictureChanges {
    std::vector<std::vector<double>> slopes, bends;
};
/// Throws Interrupted.
PictureChanges picture_changes(const SketchedStone& stone, const cv::Mat& mask, int threads,
                               const Progress& progress);

}  // namespace culet
