#pragma once
// The reference picture of a study, and its own error.

#include "compare/study/scene_study_result.h"
#include "compare/study/study_clock.h"

namespace culet {

/// The longer side (256, 192, 128, 96 or 64, at most the scene's own) for which a reference of 64
/// rays per pixel should take `seconds` of processor time.
int affordable_size(const Scene& scene, double tolerance, double seconds, StudyClock& clock);

/// The camera with this longer side.
Camera resized(const Camera& camera, int longer_side);

/// Draws two independent references with more and more rays until half their mean difference is
/// below a tenth of the finest tolerance, or the next round would exceed `seconds` of processor
/// time. Draws at least one round. Throws InputError when the stone is not in the picture.
StudyReference study_reference(const Scene& scene, double finest_tolerance, double seconds,
                               StudyClock& clock);

}  // namespace culet
