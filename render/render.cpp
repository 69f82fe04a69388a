#include "render/render.h"

#include <fmt/format.h>

#include <algorithm>

#include "render/beams/beam_picture.h"
#include "render/plan/paced_drawing.h"
#include <cstdlib>
#include "render/plan/ladder.h"
#include "render/plan/planner.h"
#include "render/plan/proven_drawing.h"
#include "render/reference.h"
#include "render/scene_checks.h"
#include "render/work_meter.h"

namespace culet {

namespace {

RenderResult drawn(const Scene& scene, const Progress& progress) {
    return drawn_by_beams(scene.settings) ? render_with_beams(scene, progress)
                                          : render_with_reference(scene, progress);
}

// What was left out unseen, the picture has shown to be near enough.
void bound_by_picture(RenderResult& result) {
    for (PlanItem& line : result.stats.plan->items) {
        const bool alone = line.name != name_of(Effects::coherence);
        if (alone && (line.why == k_as_one || line.why == k_by_its_size))
            line.bound = result.stats.error_bound;
    }
}

RenderResult drawn_as_planned(const Scene& scene, const Progress& progress) {
    require_renderable(scene);
    ProvenDrawing drawing(scene, progress);
    std::optional<Prover> prover;
    double seconds_before = 0;
    const auto proven_at_a_glance = [&](Planner& planner) -> std::optional<RenderResult> {
        const std::optional<ScenePlan> plan = planner.at_a_glance();
        if (!plan) return std::nullopt;
        ProvenPicture picture = drawing.draw(*plan, *planner.prover(), ProvenDrawing::Way::once);
        if (!picture.proven) {
            seconds_before += seconds_of(picture.result.stats) - plan->seconds_planning;
            return std::nullopt;
        }
        bound_by_picture(picture.result);
        picture.result.stats.seconds_setup += seconds_before;
        return std::move(picture.result);
    };
    if (tried_as_one_wave(scene)) {
        Planner planner(scene, progress, true);
        if (std::optional<RenderResult> quick = proven_at_a_glance(planner)) return *quick;
        const ScenePlan plan = planner.run();
        prover = planner.take_prover();
        if (prover && plan.pilot_pixels > 0) {
            ProvenPicture one = drawing.draw(plan, *prover, ProvenDrawing::Way::as_one);
            if (one.proven) {
                bound_by_picture(one.result);
                one.result.stats.seconds_setup += seconds_before;
                return std::move(one.result);
            }
            seconds_before += seconds_of(one.result.stats);
        }
    }
    RenderResult result;
    std::vector<std::string> tried;
    for (const Planner::Leave leave : {Planner::Leave::likely, Planner::Leave::surely}) {
        Planner planner(scene, progress, false, leave);
        planner.give_prover(std::move(prover));
        if (leave == Planner::Leave::likely) {
            if (std::optional<RenderResult> quick = proven_at_a_glance(planner)) return *quick;
        }
        const ScenePlan plan = planner.run();
        prover = planner.take_prover();
        if (!prover || plan.pilot_pixels == 0) {
            Scene settled = scene;
            settled.settings = plan.settings;
            result = drawn(settled, progress);
            add_plan(plan, result.stats);
            result.stats.plan = plan;
            break;
        }
        ProvenPicture picture = drawing.draw(plan, *prover, ProvenDrawing::Way::any);
        result = std::move(picture.result);
        if (!picture.misjudged || leave == Planner::Leave::surely) break;
        seconds_before += seconds_of(result.stats);
        tried = result.stats.notes;
        if (scene.settings.meter != nullptr && scene.settings.meter->limited()) continue;
        tried.push_back(
            "what was left out matters more than its pilot saw: drawn with all that is "
            "not sure to change nothing");
    }
    // What it says of the scene, every picture says.
    for (const std::string& note : result.stats.notes) {
        if (std::find(tried.begin(), tried.end(), note) == tried.end()) tried.push_back(note);
    }
    result.stats.notes = std::move(tried);
    result.stats.seconds_setup += seconds_before;
    return result;
}

// It was of this drawing alone.
void forget_meter(RenderStats& stats) {
    if (stats.plan) stats.plan->settings.meter = stats.plan->reference.meter = nullptr;
}

}  // namespace

bool leaves_something_open(const RenderSettings& settings) {
    return settings.tolerance > 0 &&
           (settings.engine == "auto" || settings.effects_auto || settings.wavelengths_nm.empty());
}

RenderResult render(const Scene& scene, const Progress& progress, const PictureSink& better) {
    const bool planned = leaves_something_open(scene.settings);
    if (planned && scene.settings.allowed_ns > 0) {
        require_renderable(scene);
        RenderResult result = draw_within_allowance(scene, progress, drawn_as_planned, better);
        forget_meter(result.stats);
        return result;
    }
    // A plan has many parts: counted together, they tell how far it is.
    Scene counted = scene;
    if (planned && progress) counted.settings.meter = std::make_shared<WorkMeter>();
    const Progress told =
        counted.settings.meter ? counted_by(progress, counted.settings.meter) : progress;
    RenderResult result = planned ? (std::getenv("LADDER") ? drawn_by_ladder(counted, told) : drawn_as_planned(counted, told)) : drawn(scene, progress);
    forget_meter(result.stats);
    RenderStats& stats = result.stats;
    const double tolerance = scene.settings.tolerance;
    if (tolerance > 0 && stats.error_bound > tolerance) {
        stats.notes.push_back(fmt::format("the error bound {:.3g} is over the tolerance {:.3g}",
                                          stats.error_bound, tolerance));
    }
    // Of a proven picture the bound says it all.
    if (!planned && tolerance > 0 && stats.standard_error > tolerance) {
        stats.notes.push_back(
            fmt::format("paths chosen at random leave a standard error of {:.3g} a pixel, over the "
                        "tolerance {:.3g}: more samples lower it",
                        stats.standard_error, tolerance));
    }
    return result;
}

}  // namespace culet
