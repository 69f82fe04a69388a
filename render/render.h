#pragma once
// Front door of the room: a scene in, a picture out, and what was left out of it.

#include <string>

#include "render/engine/render_result.h"
#include "render/scene/scene.h"
#include "stone/progress/progress.h"

namespace culet {

/// Draws with the scene's engine: the exact reference renderer, or beams. Same scene and seed, same
/// bytes, whatever the number of threads. `better`: where the tolerance is what `allowed_ns`
/// allows, told of each picture on the way, the last of which is returned. Throws InputError (stone
/// not closed, camera inside the stone) and Interrupted.
RenderResult render(const Scene& scene, const Progress& progress = {},
                    const PictureSink& better = {});

/// Draws with what was chosen for an earlier picture of the same stone and light, and tells the
/// error bound of that one: nothing is chosen or checked anew. For turntables, and for other views
/// of a scene whose plan was kept.
RenderResult render_as_planned(const Scene& scene, const ScenePlan& plan,
                               const Progress& progress = {});

/// What a picture of the scene was drawn with, for further ones of the same stone and light.
ScenePlan plan_drawn(const Scene& scene, const RenderStats& stats);

/// Whether `render` chooses anything itself: then `allowed_ns` counts.
bool leaves_something_open(const Scene& scene);

/// Where nobody says how near the picture must be, and nothing is chosen by an earlier plan: allows
/// it the usual time (k_usual_budget_ns), and answers true.
bool allow_usual_time(Scene& scene);

/// False: the picture should not be trusted. It was allowed the usual time, which was too little to
/// find out how near it is, or its error bound was held against the truth and is too low.
bool usable(const RenderStats& stats, bool was_allowed_usual_time);

/// STATS.json (docs/rendering.md) as text.
std::string stats_json(const RenderStats& stats);

}  // namespace culet
