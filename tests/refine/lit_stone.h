#pragma once
// A turntable's stone in its light, as a dealer's camera shows it: a white dome, dark where the
// camera is, over pale ground.

#include <opencv2/core.hpp>

#include "compare/turntable/edge_points.h"
#include "render/scene/scene.h"

namespace culet::synthetic {

struct SpinTruth;

class LitStone {
public:
    /// `truth` is kept by reference.
    explicit LitStone(const SpinTruth& truth) : truth_(truth) {}
    /// Levels of the ground in, levels of ground and stone out: with the stone's shadow, blurred by
    /// 0.7 pixels, sharpened by 0.6 of what is finer than 1.2 pixels.
    cv::Mat on(const cv::Mat& ground, double turn) const;

private:
    Scene scene_at(double turn) const;

    const SpinTruth& truth_;
};

/// As JPEG of that quality gives it back.
void compress(LevelPicture& picture, int quality);

}  // namespace culet::synthetic
