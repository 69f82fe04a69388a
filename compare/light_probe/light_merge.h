#pragma once
// Views of a mirror ball as one picture of all directions.

#include <vector>

#include "compare/light_probe/ball_view.h"
#include "render/scene/scene.h"
#include "stone/progress/progress.h"

namespace culet {

struct MergedLight {
    EnvironmentMap map;               ///< lat-long, radiance as the ball shows it
    std::vector<float> coverage;      ///< a texel: 0 not seen .. 1 seen in the ball's middle
    std::vector<float> disagreement;  ///< stops between two views; NaN where fewer than two see it
    double filled_sr = 0;             ///< solid angle that no view shows, filled from around it
};

/// The mean of all views weighted by their quality, then sharpened: the map is corrected until the
/// ball's pictures computed from it are the pictures taken (`passes` of Richardson 1972 and Lucy
/// 1974 over all views' pixels, weighted by quality), which undoes the blur of resampling and
/// keeps the light's energy. What no view shows is filled with the mean of what surrounds it, over
/// ever larger distances. The views' pictures need not be exposed alike: `gain` (one a view) brings
/// them to the first.
MergedLight merge_views(const std::vector<BallView>& views, const std::vector<double>& gains,
                        int width, int passes, const Progress& progress = {});

/// Means over blocks of `factor` x `factor` texels by solid angle: no light is lost. The width is a
/// multiple of 2 `factor`.
MergedLight coarsened(const MergedLight& light, int factor);

}  // namespace culet
