#pragma once
// Compares some pixels of a picture by beams with the reference.

#include "render/image/picture.h"
#include "render/reference/prepared_scene.h"

namespace culet {

struct SampledCheck {
    int pixels = 0;
    /// Mean |difference| of the luminance plus three standard errors, relative to `mean_radiance`.
    double error = 0;
};

/// Compares pixels on a grid; the reference uses the same depth and effects. `filled`: number of
/// pixels that the stone fills. `progress` may stop it: Interrupted.
SampledCheck check_against_reference(const Scene& scene, const PreparedScene& prepared,
                                     const Picture& picture, double filled, double mean_radiance,
                                     const Progress& progress);

}  // namespace culet
