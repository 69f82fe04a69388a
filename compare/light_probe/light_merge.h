#pragma once
// Merges views of a mirror ball into one picture of all directions.

#include <vector>

#include "compare/light_probe/ball_view.h"
#include "render/scene/scene.h"
#include "stone/progress/progress.h"

namespace culet {

struct MergedLight {
    EnvironmentMap map;               ///< lat-long, radiance as the ball shows it
    std::vector<float> coverage;      ///< of each texel: 0 not seen .. 1 in the ball's middle
    std::vector<float> disagreement;  ///< stops between two views; NaN where fewer than two see it
    double filled_sr = 0;             ///< solid angle that no view shows, filled in
};

/// The quality-weighted mean of all views, sharpened: `passes` of Richardson (1972) and Lucy (1974)
/// correct the map until the views' pictures computed from it match the photographs. This removes
/// resampling blur and conserves energy. Texels without a view get the mean of their surroundings,
/// over ever larger distances. `gains` bring each view's exposure to the first's.
MergedLight merge_views(const std::vector<BallView>& views, const std::vector<double>& gains,
                        int width, int passes, const Progress& progress = {});

/// Solid-angle-weighted means over blocks of `factor` x `factor` texels, which conserve the light.
/// The width must be a multiple of 2 `factor`.
MergedLight coarsened(const MergedLight& light, int factor);

}  // namespace culet
