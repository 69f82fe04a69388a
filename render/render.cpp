#include "render/render.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "render/beams/frame_renderer.h"
#include "render/engine/engine.h"
#include "render/planner/error_estimate.h"
#include "render/planner/planner.h"
#include "render/planner/refinement.h"
#include "render/planner/time_budget.h"
#include "render/setup/scene_checks.h"
#include "render/work/work_meter.h"

namespace culet {

namespace {

constexpr int k_preview_samples = 4;

RenderResult drawn(const Scene& scene, const Progress& progress) {
    return engine_of(scene.settings).draw(scene, progress);
}

// If the finished picture is close enough, its bound also covers the merged waves.
void bound_by_picture(RenderResult& result) {
    for (PlanItem& line : result.stats.plan->items) {
        const bool alone = line.name != name_of(Effects::coherence);
        if (alone && line.why == k_merged_waves) line.bound = result.stats.error_bound;
    }
}

RenderResult drawn_as_planned(const Scene& scene, const Progress& progress) {
    require_renderable(scene);
    // In turn: merge a crystal's two waves; leave out effects that the pilot finds negligible;
    // leave out only those that certainly change nothing.
    struct Try {
        bool merged_waves;
        Planner::Leave leave;
    };
    std::vector<Try> tries{{false, Planner::Leave::likely}, {false, Planner::Leave::surely}};
    if (tried_with_merged_waves(scene)) tries.insert(tries.begin(), {true, Planner::Leave::likely});
    Refinement refinement(scene, progress);
    std::optional<ErrorEstimator> estimator;
    std::vector<std::string> tried;
    double seconds_before = 0;
    RenderResult result;
    for (const Try& now : tries) {
        try {
            Planner planner(scene, progress, now.merged_waves, now.leave);
            planner.give_estimator(std::move(estimator));
            const ScenePlan plan = planner.run();
            estimator = planner.take_estimator();
            if (!estimator) {
                Scene settled = scene;
                settled.settings = plan.settings;
                result = drawn(settled, progress);
                result.stats.seconds_setup += plan.seconds_planning;
                result.stats.plan = plan;
                break;
            }
            RefinedPicture picture = refinement.draw(plan, *estimator);
            // With little work left, more effects may add more noise than they remove error.
            if (seconds_before > 0 && scene.settings.meter->limited() &&
                picture.result.stats.error_bound > result.stats.error_bound)
                break;
            result = std::move(picture.result);
            result.stats.seconds_setup += seconds_before;
            if (picture.near_enough) bound_by_picture(result);
            if (!picture.misjudged) break;
            seconds_before = seconds_of(result.stats);
            if (!now.merged_waves && now.leave == Planner::Leave::likely &&
                !scene.settings.meter->limited())
                tried.push_back(
                    "an effect that was left out matters more than its pilot showed: drawn again "
                    "with every effect that may matter");
        } catch (const OverBudget&) {
            if (seconds_before == 0) throw;
            break;  // keep the picture with fewer effects and its error
        }
    }
    result.stats.notes.insert(result.stats.notes.end(), tried.begin(), tried.end());
    return result;
}

// Draws once, as finely as the tolerance asks for by estimate.
RenderResult drawn_once(const Scene& scene, const Progress& progress) {
    require_renderable(scene);
    Scene settled = scene;
    RenderSettings& settings = settled.settings;
    if (settings.engine == k_auto_engine && refused_by_beams(scene).empty())
        settings.engine = k_beam_engine;
    // The estimator's check is better than the engine's.
    settings.check = Check::none;
    RenderResult result = drawn(settled, progress);
    if (scene.settings.check == Check::none) return result;
    const auto start = std::chrono::steady_clock::now();
    const ErrorEstimate estimate = estimate_error(settled, result.picture, progress);
    RenderStats& stats = result.stats;
    stats.checked_pixels = estimate.pixels;
    stats.error_bound = estimate.bound;
    if (drawn_by_beams(settings)) stats.engine_error = estimate.bound;
    stats.seconds_check =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return result;
}

// Light sampled at random: shows a picture with few rays per pixel first.
RenderResult drawn_with_preview(const Scene& whole, const Progress& progress,
                                const PictureSink& better) {
    const bool time_limited = whole.settings.allowed_ns > 0 && leaves_samples_open(whole);
    const Scene scene = time_limited ? with_allowed_samples(whole, progress) : whole;
    // No preview if few rays are all that is allowed.
    if (better && !(time_limited && scene.settings.samples <= k_preview_samples)) {
        Scene few = scene;
        few.settings.samples = k_preview_samples;
        few.settings.wavelength_turns = k_preview_samples;
        better(drawn(few, progress));
    }
    RenderResult result = drawn(scene, progress);
    if (result.stats.standard_error > 0) {
        result.stats.notes.push_back(
            fmt::format("noise: a pixel{} is off by {:.2g} of the mean radiance, root mean square; "
                        "four times the samples halve it",
                        time_limited ? fmt::format(" of {} samples", scene.settings.samples) : "",
                        result.stats.standard_error));
    }
    return result;
}

// The meter belongs to this drawing only.
void forget_meter(RenderStats& stats) {
    if (stats.plan) stats.plan->settings.meter = nullptr;
}

}  // namespace

ScenePlan plan_drawn(const Scene& scene, const RenderStats& stats) {
    ScenePlan plan;
    if (stats.plan) {
        plan = *stats.plan;
    } else {
        plan.settings = scene.settings;
        plan.settings.engine = stats.engine;
    }
    plan.checked_bound = stats.error_bound;
    return plan;
}

bool leaves_something_open(const Scene& scene) {
    const RenderSettings& settings = scene.settings;
    // Light around the stone is sampled at random, so no pilot can tell the error.
    if (scene.has_objects()) return false;
    if (!engine_of(settings).approaches_truth()) return false;
    return settings.tolerance > 0 && (settings.engine == k_auto_engine || settings.effects_auto ||
                                      settings.wavelengths_nm.empty());
}

RenderResult render_as_planned(const Scene& scene, const ScenePlan& plan,
                               const Progress& progress) {
    Scene settled = scene;
    RenderSettings& settings = settled.settings;
    settings = plan.settings;
    settings.seed = scene.settings.seed;
    settings.threads = scene.settings.threads;
    settings.spectral = scene.settings.spectral;
    settings.check = Check::none;
    RenderResult result = drawn(settled, progress);
    result.stats.plan = plan;
    result.stats.plan->seconds_planning = 0;
    result.stats.error_bound = plan.checked_bound;
    result.stats.notes.push_back(
        "drawn like an earlier picture of this stone and light, with the same error bound");
    return result;
}

RenderResult render(const Scene& scene, const Progress& progress, const PictureSink& better) {
    if (scene.has_objects()) return drawn_with_preview(scene, progress, better);
    const bool open = leaves_something_open(scene);
    const bool planned = open && scene.settings.check == Check::full;
    if (open && !planned) return drawn_once(scene, progress);
    if (planned && scene.settings.allowed_ns > 0) {
        require_renderable(scene);
        RenderResult result = draw_within_budget(scene, progress, drawn_as_planned, better);
        forget_meter(result.stats);
        return result;
    }
    // The meter counts all parts of a plan for the progress report.
    Scene counted = scene;
    if (planned) counted.settings.meter = std::make_shared<WorkMeter>();
    const Progress told =
        counted.settings.meter ? counted_by(progress, counted.settings.meter) : progress;
    RenderResult result = planned ? drawn_as_planned(counted, told) : drawn(scene, progress);
    forget_meter(result.stats);
    RenderStats& stats = result.stats;
    const double tolerance = scene.settings.tolerance;
    if (tolerance > 0 && stats.error_bound > tolerance) {
        stats.notes.push_back(
            fmt::format("the picture may be off by {:.2g} of its mean radiance, which is over the "
                        "tolerance {:.3g} that was asked for",
                        stats.error_bound, tolerance));
    }
    // For a checked picture the bound includes this error.
    if (!planned && tolerance > 0 && stats.standard_error > tolerance) {
        stats.notes.push_back(
            fmt::format("paths chosen at random leave a standard error of {:.3g} a pixel, over the "
                        "tolerance {:.3g}: more samples lower it",
                        stats.standard_error, tolerance));
    }
    return result;
}

bool allow_usual_time(Scene& scene) {
    if (scene.names_tolerance || scene.settings.check != Check::full ||
        !(leaves_something_open(scene) || leaves_samples_open(scene)))
        return false;
    scene.settings.allowed_ns = k_usual_budget_ns;
    return true;
}

bool usable(const RenderStats& stats, bool was_allowed_usual_time) {
    const bool rough = was_allowed_usual_time && std::isnan(stats.error_bound);
    return !rough && (!stats.verification || stats.verification->holds());
}

}  // namespace culet
