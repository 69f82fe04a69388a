#pragma once
// The picture that a study takes for the truth, and what it may itself be off by.

#include "compare/study/scene_study_result.h"
#include "compare/study/study_clock.h"

namespace culet {

/// The longer side of a picture whose reference of 64 rays a pixel is expected to take `seconds` of
/// processor time: 256, 192, 128, 96 or 64, and no more than the scene's own.
int affordable_size(const Scene& scene, double tolerance, double seconds, StudyClock& clock);

/// The camera's picture with that longer side.
Camera resized(const Camera& camera, int longer_side);

/// Two references of ever more rays, other ones in each, until half their mean difference is below
/// a tenth of the finest tolerance, or the next would take over `seconds` of processor time. The
/// first is drawn in any case. Throws InputError when the stone is not in the picture.
StudyReference study_reference(const Scene& scene, double finest_tolerance, double seconds,
                               StudyClock& clock);

}  // namespace culet
