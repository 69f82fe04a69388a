#include "render/planner/refinement.h"

#include <algorithm>
#include <chrono>

#include "render/beams/frame_renderer.h"
#include "render/engine/engine.h"
#include "render/planner/explain.h"
#include "render/planner/planner.h"
#include "render/planner/policy.h"
#include "render/work/work_meter.h"

namespace culet {

namespace {

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

void add_plan(const ScenePlan& plan, RenderStats& stats) {
    for (EffectDecision& decision : stats.effects) {
        const PlanItem& line = plan.item(name_of(decision.effect));
        decision.why = line.why;
        decision.error_bound = line.bound;
    }
}

}  // namespace

double seconds_of(const RenderStats& stats) {
    return stats.seconds_setup + stats.seconds_build + stats.seconds_shade + stats.seconds_check;
}

// The estimator checks beams, not their own check.
RenderResult Refinement::draw_with(const RenderSettings& settings) {
    drawn_.settings = settings;
    if (!drawn_by_beams(settings)) return engine_named(settings.engine).draw(drawn_, progress_);
    if (frames_) {
        frames_->show(drawn_);
    } else {
        frames_.emplace(drawn_);
        frames_->report_to(progress_);
    }
    frames_->draw(false);
    return frames_->take();
}

// Redraws the truth without the left-out effects, at the check's pixels.
bool Refinement::misjudged(const ErrorEstimate& estimate, ErrorEstimator& estimator,
                           const RenderSettings& settings, SoFar& so_far) const {
    if (estimate.pixels > so_far.pixels_without) {
        so_far.pixels_without = estimate.pixels;
        so_far.off_without = estimator.without_effects(settings.effects, estimate.pixels);
    }
    return so_far.off_without > k_misjudged * std::min(scene_.settings.tolerance, estimate.seen());
}

// Keeps the best picture; one that may miss the sun has an unknown error.
void Refinement::SoFar::take(RenderResult result, const RefinementLevel& drawn,
                             const ErrorEstimate& estimate, bool may_be_blind) {
    result.stats.seconds_setup += seconds;
    seconds = seconds_of(result.stats);
    if (best && (blind < may_be_blind ||
                 (blind == may_be_blind && result.stats.error_bound >= best->stats.error_bound)))
        return;
    blind = may_be_blind;
    best = std::move(result);
    level = drawn;
    bound_delta_e = estimate.bound_delta_e;
}

void Refinement::refine(const ScenePlan& plan, ErrorEstimator& estimator,
                        const RefinementLevels& levels, SoFar& so_far) {
    const double tolerance = scene_.settings.tolerance;
    WorkMeter* const meter = scene_.settings.meter.get();
    const bool merged = plan.item(name_of(Effects::birefringence)).why == k_merged_waves;
    const int most = merged ? k_most_merged : k_most_drawings;
    std::optional<RefinementLevel> level = levels.first();
    if (meter->limited() && !drawn_by_beams(level->settings)) {
        level = levels.within(*level, k_share_of_rest * meter->left());
        if (!level) throw OverBudget();
    }
    so_far.seconds = plan.seconds_planning;
    for (int drawing = 1; level; ++drawing) {
        const bool beams = drawn_by_beams(level->settings);
        // Prices of paths are accurate; those of beams are measured while drawing.
        if (meter->limited() && !beams && level->price_ns > meter->left()) throw OverBudget();
        meter->expect_more(2 * level->price_ns);  // roughly, with its check
        const long long spent = meter->spent();
        RenderResult result = draw_with(level->settings);
        RenderStats& stats = result.stats;
        if (beams) level->price_ns = static_cast<double>(meter->spent() - spent);
        const auto start = Clock::now();
        const double share = beams && drawing < most ? k_check_share : k_last_check_share;
        const ErrorEstimate estimate =
            estimator.estimate(result.picture, tolerance, std::max(3e7, share * level->price_ns),
                               frames_ ? &*frames_ : nullptr);
        const bool blind = beams && levels.may_miss_the_sun(level->settings);
        so_far.near_enough = estimate.bound <= tolerance && !blind;
        std::optional<RefinementLevel> other;
        // When the work allowed is used up, the picture stands as it is.
        if (!so_far.near_enough && !meter->over()) {
            so_far.misjudged = misjudged(estimate, estimator, level->settings, so_far);
            if (!so_far.misjudged && drawing < most) other = levels.after(*level, estimate);
        }
        if (blind) estimator.forget_pixels();
        stats.error_bound = estimate.bound + plan.bound_of_depth;
        stats.checked_pixels = estimate.pixels;
        if (beams) stats.engine_error = estimate.bound;
        stats.seconds_check = seconds_since(start);
        so_far.take(std::move(result), *level, estimate, blind);
        level = std::move(other);
    }
    // No other cause of the error is left.
    if (!so_far.near_enough && so_far.off_without > 0) so_far.misjudged = true;
    so_far.best->stats.seconds_setup += so_far.seconds - seconds_of(so_far.best->stats);
}

RefinedPicture Refinement::draw(ScenePlan plan, ErrorEstimator& estimator) {
    Scene window = scene_;
    if (window.camera.optics.two_windows) window.camera.width /= 2;
    SoFar so_far;
    try {
        refine(plan, estimator, RefinementLevels(window, plan, estimator), so_far);
    } catch (const OverBudget&) {
        if (!so_far.best) throw;
        so_far.misjudged = false;
    }
    RefinedPicture done{std::move(*so_far.best), so_far.near_enough, so_far.misjudged};
    plan.settings = so_far.level.settings;
    plan.engine_why = so_far.level.why;
    plan.bound_of_sampling = so_far.level.noise;
    plan.bound_delta_e = so_far.bound_delta_e;
    plan.checked_bound = done.result.stats.error_bound;
    set_resolutions(plan, scene_, scene_.settings);
    add_plan(plan, done.result.stats);
    done.result.stats.plan = std::move(plan);
    return done;
}

}  // namespace culet
