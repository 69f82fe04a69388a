#pragma once
// Sample points of eye rays in the pixel and the pupil.

#include <vector>

#include "render/scene/scene.h"

namespace culet {

/// x, y: pixels from the pixel's corner, distributed like the filter, so all samples have the same
/// weight. pupil_x, pupil_y: in the unit disc.
struct SamplePoint {
    double x = 0.5, y = 0.5, pupil_x = 0, pupil_y = 0;
};

/// The same in every pixel and run. Square counts form a regular grid in the pixel; other counts,
/// and the pupil, use an additive recurrence with the generalised golden ratio (Roberts 2018).
std::vector<SamplePoint> sample_pattern(int count, bool pupil, PixelFilter filter,
                                        double filter_radius);

}  // namespace culet
