#pragma once

#include <optional>
#include <vector>

#include "compare/study/scene_study_result.h"

namespace culet {

/// Ids, fastest first; each has an error at least 2 % smaller than any faster one.
std::vector<int> front_of(const SceneStudy& study);

/// The fastest render with a claimed error within `tolerance`.
std::optional<int> cheapest_within(const SceneStudy& study, double tolerance);

/// For each tolerance of the study.
std::vector<StudyAdvice> advice_of(const SceneStudy& study);

}  // namespace culet
