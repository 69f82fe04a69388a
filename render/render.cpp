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
constexpr double k_sampling_bound = 1.5;
// The mean of N rays is off by about N^-0.7.
constexpr double k_noise_power = 0.7;
constexpr int k_most_rays = 1600;  // of the plan

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
void add_plan(const ScenePlan& plan, int samples, RenderStats& stats) {
    const bool beams = stats.engine != "reference";
    for (EffectDecision& decision : stats.effects) {
        const PlanItem& line = plan.item(name_of(decision.effect));
        decision.why = line.why;
        decision.error_bound = line.bound;
    }
    stats.seconds_setup += plan.seconds_planning;
    if (plan.pilot_pixels == 0) return;
    // The pilot's word on few rays and few wavelengths, or what the picture shows if that is more.
    const double sampling =
        std::max(plan.bound_of_sampling *
                     std::pow(static_cast<double>(plan.reference.samples) / std::max(1, samples),
                              k_noise_power),
                 k_sampling_bound * stats.sampling_error);
    stats.error_bound = plan.bound + (beams ? stats.engine_error : sampling);
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
    ScenePlan plan = plan_scene(scene);
    Scene settled = scene;
    settled.settings = plan.settings;
    RenderResult best = drawn(settled, progress);
    add_plan(plan, settled.settings.samples, best.stats);
    // Where the picture shows more error than the pilot did: the reference instead of beams, and
    // once more rays.
    const double tolerance = scene.settings.tolerance;
    const bool beams_are_open = scene.settings.engine == "auto",
               rays_are_open = scene.settings.samples == 0;
    for (int attempt = 0; attempt < 2 && plan.pilot_pixels > 0; ++attempt) {
        RenderStats& stats = best.stats;
        if (proven(stats, tolerance)) break;
        std::string why;
        if (drawn_by_beams(settled.settings)) {
            if (!beams_are_open || plan.bound + plan.bound_of_sampling >= stats.error_bound) break;
            settled.settings = plan.reference;

            why = fmt::format("beams came to within {:.2g} only: drawn by the reference instead",
                              stats.engine_error);
        } else {
            const double room = tolerance - plan.bound, off = stats.error_bound - plan.bound;
            if (!rays_are_open || !(room > 0) || settled.settings.samples >= k_most_rays) break;
            why = fmt::format("{} rays a pixel were off by {:.2g}: drawn with more",
                              settled.settings.samples, off);
            settled.settings.samples = rays_to_reach(room, settled.settings.samples, off);
        }
        RenderResult next = drawn(settled, progress);
        add_plan(plan, settled.settings.samples, next.stats);
        next.stats.seconds_setup +=
            stats.seconds_setup + stats.seconds_build + stats.seconds_shade + stats.seconds_check;
        next.stats.notes.push_back(why);
        if (!(next.stats.error_bound < stats.error_bound)) break;
        best = std::move(next);
        plan.settings = settled.settings;
    }
    best.stats.plan = plan;
    return best;
}

}  // namespace culet
