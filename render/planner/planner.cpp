#include "render/planner/planner.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "render/beams/frame_renderer.h"
#include "render/planner/refinement_levels.h"
#include "render/planner/resolutions.h"
#include "render/planner/wavelengths.h"
#include "render/scene/fingerprint.h"
#include "render/setup/a_priori.h"

namespace culet {

namespace {

// The pilots', and others that tell how noisy the truth is.
constexpr int k_pilot_pixels = 96, k_check_pixels = 64;
// Trees that branch play roulette: pictures that are held against each other should differ by what
// is looked at rather than by chance, so at weights far below the noise of a pixel's few rays.
constexpr double k_pilot_roulette = 0.01, k_pilot_split = 0.1;
// Pilots of a depth that the scene names are held against such as go on to here.
constexpr double k_deep_cut = 0.01;
// Faces that light meets, and rays of all pilots in a pixel, about: what weighing effects costs.
constexpr double k_usual_events = 8, k_usual_rays_of_pilots = 160;
// Rays that the guess of a picture's time by the reference is for.
constexpr int k_usual_rays = 16;

}  // namespace

Planner::Planner(const Scene& whole, const Progress& progress, bool merged_waves, Leave leave)
    : scene_(whole),
      user_(whole.settings),
      progress_(progress),
      tolerance_(whole.settings.tolerance),
      merged_waves_(merged_waves),
      leave_(leave) {
    // The two windows of a dichroscope are one view, seen twice.
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
    if (!merged_waves_) return;
    for (Effects effect : {Effects::birefringence, Effects::pleochroism, Effects::coherence}) {
        item(effect).on = false;
        item(effect).why = k_merged_waves;
    }
    branches_ = !scene_.stone.convex;
}

bool tried_with_merged_waves(const Scene& scene) {
    const OpticalSetup plan = make_optical_setup(scene);
    return scene.settings.effects_auto && scene.settings.engine == k_auto_engine && plan.splits &&
           !plan.stokes && scene.stone.convex;
}

ScenePlan Planner::run() {
    begin();
    if (!pixels_.at.empty()) {
        if (leave_ == Leave::surely || costs_less_than_pilots()) {
            for (PlanItem& line : plan_.items) {
                if (line.on) line.matters = line.matters_delta_e = k_unknown;
            }
        } else {
            weigh_effects();
        }
    }
    finish();
    return std::move(plan_);
}

ScenePlan Planner::run_to_explain(bool everything) {
    begin();
    if (!pixels_.at.empty()) weigh_effects();
    finish();
    if (everything) measure_what_the_scene_forbids();
    return std::move(plan_);
}

void Planner::begin() {
    plan_.tolerance = tolerance_;
    say_what_is_known();
    find_pixels();
    if (pixels_.at.empty()) {
        settle_without_pilot();
        return;
    }
    plan_.pixels = pixels_.in_picture;
    plan_.pilot_pixels = static_cast<int>(pixels_.at.size());
    drop_what_changes_nothing();
}

void Planner::finish() {
    settle_effects();
    if (!pixels_.at.empty()) {
        bound_depth();
        choose_first_picture();
        estimate_times();
    }
    set_resolutions(plan_, scene_, user_);
    plan_.bound = spent_ + plan_.bound_of_depth;
    for (const PlanItem& line : plan_.items) {
        // Whether waves interfere is a matter of the light, which the scene settles.
        if (line.name != name_of(Effects::coherence)) plan_.bound_delta_e += line.bound_delta_e;
    }
    plan_.seconds_planning =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

void Planner::settle_effects() {
    for (std::size_t e = 0; e < k_effect_count; ++e) plan_.settings.effects[e] = plan_.items[e].on;
}

// Pilots of paths of so many faces, about.
bool Planner::costs_less_than_pilots() {
    if (branches_ || !user_.effects_auto || on(Effects::aperture) || user_.depth > 0) return false;
    PathWork ray;
    ray.rays = 1;
    ray.events = k_usual_events;
    const double pilots =
        k_usual_rays_of_pilots * static_cast<double>(pixels_.at.size()) * price_ns(ray);
    settle_effects();
    const RefinementLevel first = RefinementLevels(scene_, plan_, *estimator_, progress_).first();
    return drawn_by_beams(first.settings) && first.price_ns <= pilots;
}

void Planner::weigh_effects() {
    first_ = draw(at_pilot_wavelengths(with_effects(false)), k_pilot_rays);
    work_ = whole_ = work_of(at_pilot_wavelengths(with_effects(false)), first_, k_pilot_rays);
    choose_effects();
    // Without the split there is one way through the stone.
    if (!on(Effects::birefringence)) branches_ = !scene_.stone.convex;
    try_without_dispersion();
    plan_.mean_radiance = first_.mean;
    plan_.events_per_ray = work_.events / std::max(work_.rays, 1e-9);
    // What this machine's nanosecond is worth.
    const double priced = static_cast<double>(pixels_.at.size()) * k_pilot_rays * price_ns(whole_);
    if (priced > 0 && first_.seconds > 0) machine_ = 1e9 * first_.seconds / priced;
}

Scene Planner::with_effects(bool dispersion, std::optional<Effects> without) const {
    Scene scene = scene_;
    RenderSettings& settings = scene.settings;
    settings.effects_auto = false;
    for (int e = 0; e < k_effect_count; ++e)
        settings.effects[static_cast<std::size_t>(e)] = plan_.items[static_cast<std::size_t>(e)].on;
    if (!dispersion) settings.effects[static_cast<std::size_t>(Effects::dispersion)] = false;
    if (without) settings.effects[static_cast<std::size_t>(*without)] = false;
    return scene;
}

Scene Planner::at_pilot_wavelengths(Scene scene) const {
    std::vector<double>& nm = scene.settings.wavelengths_nm;
    if (nm.empty()) {
        nm = k_three_nm;
    } else if (nm.size() > 3) {
        nm = {nm.front(), nm[nm.size() / 2], nm.back()};
    }
    return scene;
}

PathLimits Planner::limits() const {
    PathLimits limits;
    limits.seed = user_.seed;
    limits.depth = user_.depth > 0 ? user_.depth : k_deepest;
    limits.cut_weight = branches_ ? k_pilot_roulette : k_pilot_cut * tolerance_;
    limits.split_weight = k_pilot_split;
    limits.roulette = branches_;
    limits.alike = true;
    return limits;
}

PilotDrawing Planner::draw(const Scene& scene, int samples) const {
    return draw_pilot(scene, pixels_, limits(), samples, k_node_counts[1], progress_);
}

PathWork Planner::work_of(const Scene& scene, const PilotDrawing& drawing, int samples) const {
    const OpticalSetup plan = make_optical_setup(scene);
    const double rays =
        static_cast<double>(pixels_.at.size()) * samples * static_cast<double>(plan.bands.size());
    PathWork work = work_along_paths(plan);
    work.rays = drawing.rays / rays;
    work.events = drawing.events / rays;
    return work;
}

void Planner::settle_without_pilot() {
    RenderSettings& settings = plan_.settings;
    if (settings.engine == k_auto_engine) settings.engine = k_reference_engine;
    plan_.engine_why = tolerance_ > 0 ? "no ray of the pilot met the stone"
                                      : "with tolerance 0 nothing is left out";
    for (PlanItem& line : plan_.items) {
        if (line.on) line.matters = line.matters_delta_e = k_unknown;
    }
    spent_ = k_unknown;
    plan_.bound_of_sampling = k_unknown;
}

void Planner::find_pixels() {
    if (!(tolerance_ > 0)) return;
    const StonePixels all = stone_pixels(scene_, k_pilot_pixels + k_check_pixels);
    pixels_ = all.stretch(0, k_pilot_pixels);
    if (pixels_.at.empty() || estimator_) return;
    // A stone of few pixels is checked at all of them.
    const bool few = all.at.size() < k_pilot_pixels + k_check_pixels;
    estimator_.emplace(scene_, all.stretch(few ? 0 : k_pilot_pixels, k_check_pixels), tolerance_,
                       progress_);
}

// What is known beforehand needs no pilot.
void Planner::drop_what_changes_nothing() {
    if (!user_.effects_auto || !same_light_everywhere(scene_.lights) || on(Effects::absorption) ||
        scene_.camera.optics.analyzer)
        return;
    for (Effects effect : {Effects::dispersion, Effects::birefringence, Effects::polarization,
                           Effects::pleochroism, Effects::coherence}) {
        if (!on(effect)) continue;
        PlanItem& line = item(effect);
        Scene without = with_effects(false, effect);
        if (effect != Effects::dispersion && make_optical_setup(without).on(effect)) continue;
        line.on = false;
        line.why = k_same_light;
        line.bound = 0;
    }
    if (make_optical_setup(with_effects(false)).splits) return;
    branches_ = !scene_.stone.convex;
}

// A depth that the scene names may be shallower than the light goes.
void Planner::bound_depth() {
    if (user_.depth == 0) return;
    const Scene scene = at_pilot_wavelengths(with_effects(false));
    PathLimits deep = limits();
    if (!branches_) deep.cut_weight = k_deep_cut * tolerance_;
    PathLimits shallow = deep;
    deep.depth = k_deepest;
    const auto at = [&](const PathLimits& how) {
        return draw_pilot(scene, pixels_, how, k_pilot_rays, k_node_counts[1], progress_);
    };
    const PilotDrawing cut_short = at(shallow), whole = at(deep);
    const ColourError error = colour_error(cut_short.rgb, whole.rgb);
    // Beforehand: what goes no further sees at most the brightest light.
    const double known =
        whole.mean > 0 ? cut_short.remainder * whole.brightest / whole.mean : error.bound();
    plan_.bound_of_depth = branches_ ? error.bound() : std::min(error.bound(), known);
}

void Planner::choose_first_picture() {
    const RefinementLevel first = RefinementLevels(scene_, plan_, *estimator_, progress_).first();
    plan_.settings = first.settings;
    plan_.engine_why = first.why;
    plan_.seconds = first.price_ns;
    plan_.bound_of_sampling = first.noise;
}

// By counts of faces met.
void Planner::estimate_times() {
    const double seconds = 1e-9 * machine_;
    plan_.seconds *= seconds;
    const int rays_of_all = std::max(plan_.settings.samples, k_usual_rays);
    plan_.seconds_everything =
        std::max(plan_.seconds, seconds * pixels_.in_picture * rays_of_all * price_ns(whole_) *
                                    (on(Effects::dispersion) ? 4 : 1));
    for (PlanItem& line : plan_.items) {
        // So far they hold prices of the pilot with and without.
        const double with = line.seconds_with, without = line.seconds_without;
        line.seconds_with = line.seconds_without = plan_.seconds;
        if (!(with > 0 && without > 0)) continue;
        if (line.on) {
            line.seconds_without = plan_.seconds * without / with;
        } else {
            line.seconds_with = plan_.seconds * with / without;
        }
    }
}

}  // namespace culet
