#include "render/render.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "render/beams/beam_picture.h"
#include "render/reference.h"
#include "render/scene_checks.h"

namespace culet {

namespace {

// Half the difference of the halves of a pixel's rays is not quite what all of them are off by.
constexpr double k_sampling_bound = 1.3;

bool leaves_something_open(const RenderSettings& settings) {
    return settings.tolerance > 0 &&
           (settings.engine == "auto" || settings.effects_auto || settings.wavelengths_nm.empty());
}

RenderResult drawn(const Scene& scene, const Progress& progress) {
    return drawn_by_beams(scene.settings) ? render_with_beams(scene, progress)
                                          : render_with_reference(scene, progress);
}

bool proven(const RenderStats& stats, double tolerance) {
    return stats.error_bound <= tolerance;
}

// What the picture itself says of its error, and what the plan says of what it left out.
void add_plan(const ScenePlan& plan, RenderStats& stats) {
    const bool beams = stats.engine != "reference";
    for (EffectDecision& decision : stats.effects) {
        const PlanItem& line = plan.item(name_of(decision.effect));
        decision.why = line.why;
        decision.error_bound = line.bound;
    }
    stats.seconds_setup += plan.seconds_planning;
    if (plan.pilot_pixels == 0) return;
    stats.error_bound =
        plan.bound + (beams                      ? stats.engine_error
                      : stats.sampling_error > 0 ? k_sampling_bound * stats.sampling_error
                                                 : plan.bound_of_sampling);
    std::erase_if(stats.notes, [](const std::string& note) {
        return note.find("over the tolerance") != std::string::npos;
    });
    if (!proven(stats, plan.settings.tolerance)) {
        stats.notes.push_back(fmt::format("the error bound {:.3g} is over the tolerance {:.3g}",
                                          stats.error_bound, plan.settings.tolerance));
    }
}

}  // namespace

RenderResult render(const Scene& scene, const Progress& progress) {
    if (!leaves_something_open(scene.settings)) return drawn(scene, progress);
    require_renderable(scene);
    const ScenePlan plan = plan_scene(scene);
    Scene settled = scene;
    settled.settings = plan.settings;
    RenderResult result = drawn(settled, progress);
    add_plan(plan, result.stats);
    if (scene.settings.engine == "auto" && drawn_by_beams(plan.settings) &&
        !proven(result.stats, scene.settings.tolerance)) {
        // The beams were not shown to be near enough.
        const double took =
            result.stats.seconds_build + result.stats.seconds_shade + result.stats.seconds_check;
        const double measured = result.stats.engine_error;
        settled.settings = plan.reference;
        settled.settings.effects = plan.settings.effects;
        result = render_with_reference(settled, progress);
        result.stats.seconds_setup += took;
        add_plan(plan, result.stats);
        result.stats.notes.push_back(fmt::format(
            "beams came to within {:.2g} only: drawn by the reference instead", measured));
    }
    result.stats.plan = plan;
    return result;
}

}  // namespace culet
