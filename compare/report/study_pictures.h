#pragma once
// The pictures of a study as its page shows them.

#include <vector>

#include "compare/study/scene_study_result.h"
#include "page/scene_study_page.h"

namespace culet {

/// The reference and the renders on the front.
std::vector<SceneStudyPicture> study_pictures(const SceneStudy& study);

}  // namespace culet
