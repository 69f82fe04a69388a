#pragma once
// Draws a scene and reports what the picture leaves out.

#include <string>

#include "render/engine/render_result.h"
#include "render/scene/scene.h"
#include "stone/progress/progress.h"

namespace culet {

/// Draws with the scene's engine. The bytes depend on scene and seed only, not on the number of
/// threads. If `allowed_ns` decides the tolerance, `better` receives each picture on the way,
/// including the returned one. Throws InputError (stone not closed, camera inside the stone) and
/// Interrupted.
RenderResult render(const Scene& scene, const Progress& progress = {},
                    const PictureSink& better = {});

/// Draws with the plan of an earlier picture of the same stone and light, and reports that
/// picture's error bound. Nothing is chosen or checked anew. For turntables and other views.
RenderResult render_as_planned(const Scene& scene, const ScenePlan& plan,
                               const Progress& progress = {});

/// The plan behind a picture of the scene, for `render_as_planned`.
ScenePlan plan_drawn(const Scene& scene, const RenderStats& stats);

/// Whether `render` has anything to choose. Only then does `allowed_ns` count.
bool leaves_something_open(const Scene& scene);

/// Allows the scene the usual time (k_usual_budget_ns) and returns true, unless it names a
/// tolerance or nothing is left to choose.
bool allow_usual_time(Scene& scene);

/// False if the usual time was too short to estimate the error, or verification showed that the
/// error bound is too low.
bool usable(const RenderStats& stats, bool was_allowed_usual_time);

/// STATS.json (docs/rendering.md) as text.
std::string stats_json(const RenderStats& stats);

}  // namespace culet
