#pragma once
// What `culet render` says about a picture that it has drawn.

#include "render/engine/render_result.h"
#include "render/planner/verify.h"
#include "render/scene/scene.h"

namespace culet {

/// k_usual_budget_ns in words for people.
constexpr int k_usual_seconds = 3;

/// Says how accurate the picture is, if that was left to culet.
void print_accuracy(const RenderStats& stats, Check check, bool time_limited, bool quiet);
void say_all_about(const RenderStats& stats);
void say_verified(const Verification& found, bool quiet);

}  // namespace culet
