#include "render/planner/planner.h"

#include <algorithm>
#include <array>

#include "render/beams/frame_renderer.h"
#include "render/planner/explain.h"
#include "render/planner/policy.h"
#include "render/planner/refinement_levels.h"
#include "render/scene/fingerprint.h"
#include "render/setup/a_priori.h"

namespace culet {

namespace {

// Effects decided by pilots, most expensive first, with the share of the tolerance below which each
// is left out: smaller for those that cost next to nothing.
struct PilotedEffect {
    Effects effect;
    double share;
};
constexpr std::array k_piloted{PilotedEffect{Effects::birefringence, k_share_of_effects},
                               PilotedEffect{Effects::aperture, k_share_of_effects},
                               PilotedEffect{Effects::polarization, k_share_of_effects},
                               PilotedEffect{Effects::pleochroism, k_share_of_cheap},
                               PilotedEffect{Effects::absorption, k_share_of_cheap},
                               PilotedEffect{Effects::dispersion, k_share_of_effects}};

}  // namespace

Planner::Planner(const Scene& whole, const Progress& progress, bool merged_waves, Leave leave)
    : scene_(whole),
      user_(whole.settings),
      progress_(progress),
      tolerance_(whole.settings.tolerance),
      leave_(leave),
      rays_(whole.camera.aperture_radius > 0 ? k_lens_rays : k_pilot_rays) {
    // The two windows of a dichroscope show one view twice.
    if (scene_.camera.optics.two_windows) scene_.camera.width /= 2;
    const OpticalSetup base = make_optical_setup(scene_);
    branches_ = paths_branch(scene_, base);
    for (const EffectDecision& decision : base.effects) {
        PlanItem line;
        line.name = name_of(decision.effect);
        line.on = decision.on;
        line.why = decision.why;
        line.bound = decision.error_bound;
        plan_.items.push_back(line);
    }
    Fingerprint print;
    print.add_stone_and_light(whole);
    plan_.stone_and_light = print.hex();
    plan_.settings = user_;
    plan_.settings.effects_auto = false;
    plan_.tolerance = tolerance_;
    if (merged_waves) {
        for (Effects effect : {Effects::birefringence, Effects::pleochroism, Effects::coherence})
            leave_out(effect, k_merged_waves);
        branches_ = !scene_.stone.convex;
    }
    explain_known_effects(scene_, plan_);
}

bool tried_with_merged_waves(const Scene& scene) {
    const OpticalSetup plan = make_optical_setup(scene);
    return scene.settings.effects_auto && scene.settings.engine == k_auto_engine && plan.splits &&
           !plan.stokes && scene.stone.convex;
}

ScenePlan Planner::run() {
    return run(false);
}

ScenePlan Planner::run_to_explain(bool everything) {
    ScenePlan plan = run(true);
    if (!everything || user_.effects_auto || pixels_.at.empty()) return plan;
    plan_ = std::move(plan);
    measure_disabled_effects();
    return std::move(plan_);
}

ScenePlan Planner::run(bool weigh) {
    find_pixels();
    const bool any = !pixels_.at.empty();
    if (any) {
        plan_.pixels = pixels_.in_picture;
        plan_.pilot_pixels = static_cast<int>(pixels_.at.size());
        drop_exact_effects();
        weigh = weigh || (leave_ == Leave::likely && !costs_less_than_pilots());
    }
    if (any && weigh) {
        weigh_effects();
    } else {
        for (PlanItem& line : plan_.items)
            if (line.on) line.matters = line.matters_delta_e = k_unknown;
    }
    for (std::size_t e = 0; e < k_effect_count; ++e) plan_.settings.effects[e] = plan_.items[e].on;
    if (any) {
        bound_depth();
        choose_first_picture();
        estimate_times();
        plan_.bound += plan_.bound_of_depth;
    } else {
        if (plan_.settings.engine == k_auto_engine) plan_.settings.engine = k_reference_engine;
        plan_.engine_why = tolerance_ > 0 ? "no ray of the pilot met the stone"
                                          : "with tolerance 0 nothing is left out";
        plan_.bound = plan_.bound_of_sampling = k_unknown;
    }
    set_resolutions(plan_, scene_, user_);
    for (const PlanItem& line : plan_.items) {
        // Interference is a property of the light, which the scene decides.
        if (line.name != name_of(Effects::coherence)) plan_.bound_delta_e += line.bound_delta_e;
    }
    plan_.seconds_planning =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    return std::move(plan_);
}

void Planner::find_pixels() {
    if (!(tolerance_ > 0)) return;
    const std::size_t checked = k_first_pixels;
    const StonePixels all = stone_pixels(scene_, k_pilot_pixels + static_cast<int>(checked));
    pixels_ = all.range(0, k_pilot_pixels);
    if (pixels_.at.empty() || estimator_) return;
    // A stone of few pixels is checked at all of them.
    const bool few = all.at.size() < k_pilot_pixels + checked;
    estimator_.emplace(scene_, all.range(few ? 0 : k_pilot_pixels, checked), tolerance_, progress_);
}

void Planner::leave_out(Effects effect, std::string why) {
    item(effect).on = false;
    item(effect).why = std::move(why);
}

void Planner::drop_exact_effects() {
    if (!user_.effects_auto || !same_light_everywhere(scene_.lights) || on(Effects::absorption) ||
        scene_.camera.optics.analyzer)
        return;
    for (Effects effect : {Effects::dispersion, Effects::birefringence, Effects::polarization,
                           Effects::pleochroism, Effects::coherence}) {
        if (!on(effect)) continue;
        // The scene may need this effect.
        if (effect != Effects::dispersion && make_optical_setup(piloted({effect})).on(effect))
            continue;
        leave_out(effect, k_same_light);
        item(effect).bound = 0;
    }
    if (!make_optical_setup(piloted()).splits) branches_ = !scene_.stone.convex;
}

bool Planner::costs_less_than_pilots() {
    if (branches_ || !user_.effects_auto || on(Effects::aperture) || user_.depth > 0) return false;
    PathWork pilots;
    pilots.rays = k_rays_of_pilots * static_cast<double>(pixels_.at.size());
    pilots.events = k_faces_per_ray * pilots.rays;
    ScenePlan plan = plan_;
    for (std::size_t e = 0; e < k_effect_count; ++e) plan.settings.effects[e] = plan.items[e].on;
    const RefinementLevel first = RefinementLevels(scene_, plan, *estimator_).first();
    return drawn_by_beams(first.settings) && first.price_ns <= price_ns(pilots);
}

void Planner::weigh_effects() {
    first_ = draw(piloted());
    whole_price_ = price_of(piloted(), first_);
    // Calibrates prices to this machine.
    const double priced = whole_price_ * static_cast<double>(pixels_.at.size());
    if (priced > 0 && first_.seconds > 0) machine_ = 1e9 * first_.seconds / priced;
    for (const PilotedEffect& next : k_piloted) {
        // Dispersion comes last: it uses one wave if the waves are merged.
        if (next.effect == Effects::dispersion) {
            bound_coherence();
            if (!on(Effects::birefringence)) branches_ = !scene_.stone.convex;
        }
        const bool was = on(next.effect);
        try_without(next.effect, next.share);
        if (!was || on(next.effect)) continue;
        if (next.effect == Effects::birefringence) {
            item(Effects::coherence).why = k_merged_waves;
            item(Effects::coherence).on = false;
            if (on(Effects::pleochroism)) leave_out(Effects::pleochroism, k_merged_waves);
        } else if (next.effect == Effects::absorption && on(Effects::pleochroism)) {
            leave_out(Effects::pleochroism, "nothing is absorbed");
        }
    }
    plan_.mean_radiance = first_.mean;
    plan_.events_per_ray = first_.events / std::max(first_.rays, 1e-9);
}

void Planner::choose_first_picture() {
    const RefinementLevel first = RefinementLevels(scene_, plan_, *estimator_).first();
    plan_.settings = first.settings;
    plan_.engine_why = first.why;
    plan_.seconds = 1e-9 * machine_ * first.price_ns;
    plan_.bound_of_sampling = first.noise;
}

// From counts of faces met; "everything" by the reference with 16 rays or more.
void Planner::estimate_times() {
    const double rays = std::max(plan_.settings.samples, 16);
    plan_.seconds_everything =
        std::max(plan_.seconds, 1e-9 * machine_ * plan_.pixels * whole_price_ * rays / rays_ *
                                    (on(Effects::dispersion) ? 4 : 1));
    for (PlanItem& line : plan_.items) {
        // These fields still hold the pilot's prices.
        const double with = line.seconds_with, without = line.seconds_without;
        line.seconds_with = line.seconds_without = plan_.seconds;
        if (!(with > 0 && without > 0)) continue;
        (line.on ? line.seconds_without : line.seconds_with) *=
            line.on ? without / with : with / without;
    }
}

}  // namespace culet
