#pragma once
// Where in a pixel and in the pupil its eye rays start.

#include <vector>

#include "render/scene/scene.h"

namespace culet {

/// x, y in pixels from the pixel's corner, distributed as the filter (so that every sample weighs
/// the same); a point of the unit disc of the pupil.
struct SamplePoint {
    double x = 0.5, y = 0.5, pupil_x = 0, pupil_y = 0;
};

/// The same in every pixel and every run. Square counts are a regular grid in the pixel, others
/// an additive recurrence with the generalised golden ratio (Roberts 2018); so is the pupil.
std::vector<SamplePoint> sample_pattern(int count, bool pupil, PixelFilter filter,
                                        double filter_radius);

}  // namespace culet
