#pragma once
// The names run round the stone the other way than in the mesh. Private to the room.

#include "fit/hypotheses/hypotheses.h"

namespace culet {

std::optional<Problem> mesh_mirrored(const Problem& given, const Attempt& first);
Verdict judge_mirrored_mesh(const Problem& given, const Attempt& first, const Problem& changed,
                            FitResult again);

}  // namespace culet
