#pragma once
// How far a picture by beams is from the reference, at some of its pixels.

#include "render/image/picture.h"
#include "render/reference/prepared_scene.h"

namespace culet {

struct SampledCheck {
    int pixels = 0;
    /// Mean of |difference| of the luminance and three standard errors, relative to
    /// `mean_radiance`.
    double error = 0;
};

/// Pixels on a grid, as the reference sees them to the same depth and with the same effects.
/// `filled`: pixels that the stone fills. `progress` may stop it: Interrupted.
SampledCheck check_against_reference(const Scene& scene, const PreparedScene& prepared,
                                     const Picture& picture, double filled, double mean_radiance,
                                     const Progress& progress);

}  // namespace culet
