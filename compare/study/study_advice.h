#pragma once
// What a study recommends.

#include <optional>
#include <vector>

#include "compare/study/scene_study_result.h"

namespace culet {

/// Ids of the renders, quickest first; each is nearer to the truth by 2 % than any quicker one.
std::vector<int> front_of(const SceneStudy& study);

/// The id of the quickest render whose claimed error is within; nothing when none is.
std::optional<int> cheapest_within(const SceneStudy& study, double tolerance);

/// For each tolerance of the study.
std::vector<StudyAdvice> advice_of(const SceneStudy& study);

}  // namespace culet
