#include "render/plan/planner.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "render/colour_error.h"
#include "render/plan/a_priori.h"

namespace culet {

namespace {

// Wavelengths that pilots of effects are drawn at: three carry any colour of light.
const std::vector<double> k_pilot_nm{450, 550, 610};
constexpr int k_least_pixels = 96, k_most_pixels = 400;
// Of stones whose light paths do not branch: their rays cost little.
constexpr int k_least_plain_pixels = 96;
// That tell how noisy the truth is; they are others than the pilots'.
constexpr int k_proof_pixels = 64;
// Of the picture's price that a plan may cost, and what it may cost in any case.
constexpr double k_planning_share = 0.04, k_planning_ns = 1.5e6;
constexpr int k_more_cuts = 3;
// Trees that branch: far below the noise of a pixel's few rays, and half as dear as following
// paths of a tenth of these weights. Pictures that are held against each other should differ by
// what is looked at rather than by chance; the finished one may leave more to it.
constexpr double k_split_weight = 0.1, k_gambled_weight = 0.01, k_picture_split_weight = 0.6,
                 k_picture_gambled_weight = 0.04, k_fine_tolerance = 0.02;

}  // namespace

Planner::Planner(const Scene& whole, const Progress& progress, bool one_wave, Leave leave)
    : scene_(whole),
      user_(whole.settings),
      progress_(progress),
      tolerance_(whole.settings.tolerance),
      one_wave_(one_wave),
      leave_(leave) {
    // The two windows of a dichroscope are one view, seen twice.
    if (scene_.camera.optics.two_windows) scene_.camera.width /= 2;
    const Plan base = make_plan(scene_);
    branches_ = base.splits || !scene_.stone.convex;
    for (const EffectDecision& decision : base.effects) {
        PlanItem line;
        line.name = name_of(decision.effect);
        line.on = decision.on;
        line.why = decision.why;
        line.bound = decision.error_bound;
        plan_.items.push_back(line);
    }
    plan_.settings = user_;
    plan_.settings.effects_auto = false;
    if (!one_wave_) return;
    for (Effects effect : {Effects::birefringence, Effects::pleochroism, Effects::coherence}) {
        item(effect).on = false;
        item(effect).why = k_as_one;
    }
    branches_ = !scene_.stone.convex;
}

bool tried_as_one_wave(const Scene& scene) {
    const Plan plan = make_plan(scene);
    return scene.settings.effects_auto && scene.settings.engine == "auto" && plan.splits &&
           !plan.stokes && scene.stone.convex;
}

void Planner::look() {
    if (looked_) return;
    looked_ = true;
    const auto start = std::chrono::steady_clock::now();
    say_what_is_known();
    plan_.tolerance = tolerance_;
    if (tolerance_ > 0) pixels_ = stone_pixels(scene_, k_least_plain_pixels + k_proof_pixels);
    if (!pixels_.at.empty()) {
        choose_pixels();
        drop_what_changes_nothing();
    }
    seconds_looking_ =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

ScenePlan Planner::run(bool everything) {
    look();
    const auto start = std::chrono::steady_clock::now();
    if (pixels_.at.empty()) {
        settle_without_pilot();
    } else {
        choose_cut();
        choose_effects();
        if (branches_ && scene_.stone.convex && !on(Effects::birefringence)) {
            // Without the split there is one way through the stone, which is cut and not gambled
            // on.
            branches_ = false;
            const PathWork whole = whole_;
            choose_cut();
            whole_ = whole;
        }
        choose_wavelengths();
        choose_engine_and_samples();
        bound_depth();
        estimate_times();
    }
    finish();
    plan_.bound = spent_ + plan_.bound_of_depth;
    if (everything) measure_what_the_scene_forbids();
    for (const PlanItem& line : plan_.items) {
        // Whether waves interfere is a matter of the light, which the scene settles.
        if (line.name != name_of(Effects::coherence)) plan_.bound_delta_e += line.bound_delta_e;
    }
    plan_.seconds_planning =
        seconds_looking_ +
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return std::move(plan_);
}

void Planner::finish() {
    for (int e = 0; e < k_effect_count; ++e)
        plan_.settings.effects[static_cast<std::size_t>(e)] =
            plan_.items[static_cast<std::size_t>(e)].on;
    plan_.reference.effects = plan_.settings.effects;
    add_resolutions();
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
        nm = k_pilot_nm;
    } else if (nm.size() > 3) {
        nm = {nm.front(), nm[nm.size() / 2], nm.back()};
    }
    return scene;
}

PathLimits Planner::limits(double cut) const {
    PathLimits limits;
    limits.seed = user_.seed;
    limits.depth = user_.depth > 0 ? user_.depth : k_deepest;
    limits.cut_weight = branches_ ? std::max(cut, k_gambled_weight) : cut;
    limits.split_weight = std::max(k_split_weight, cut);
    limits.roulette = branches_;
    limits.alike = true;
    return limits;
}

PathLimits Planner::limits_of_picture() const {
    PathLimits limits = this->limits(cut_);
    // Of many rays each may leave more to chance: so it comes to little noise soonest.
    if (branches_ && tolerance_ >= k_fine_tolerance) {
        limits.cut_weight = k_picture_gambled_weight;
        limits.split_weight = k_picture_split_weight;
    }
    return limits;
}

PilotDrawing Planner::draw(const Scene& scene, int samples) const {
    return draw_pilot(scene, pixels_, limits(cut_), samples, k_node_counts[1], progress_);
}

PathWork Planner::work_of(const Scene& scene, const PilotDrawing& drawing, int samples) const {
    const Plan plan = make_plan(scene);
    const double rays =
        static_cast<double>(pixels_.at.size()) * samples * static_cast<double>(plan.bands.size());
    PathWork work;
    work.rays = drawing.rays / rays;
    work.events = drawing.events / rays;
    work.general = plan.general;
    work.polarised = plan.polarised;
    work.nodes = plan.bands.front().count;
    return work;
}

void Planner::settle_without_pilot() {
    RenderSettings& settings = plan_.settings;
    if (settings.engine == "auto") settings.engine = "reference";
    plan_.engine_why = tolerance_ > 0 ? "no ray of the pilot met the stone"
                                      : "with tolerance 0 nothing is left out";
    for (PlanItem& line : plan_.items) {
        if (line.on) line.matters = line.matters_delta_e = k_unknown;
    }
    spent_ = k_unknown;
    plan_.bound_of_sampling = k_unknown;
}

// As many pixels as the picture's price allows.
void Planner::choose_pixels() {
    StonePixels all = std::move(pixels_);
    const int least = branches_ ? k_least_pixels : k_least_plain_pixels;
    pixels_ = all.stretch(0, static_cast<std::size_t>(least));
    const Scene scene = at_glance_wavelengths(with_effects(false));
    const double mean_guess = std::max(tolerance_ * 0.1, 1e-4);
    glance_ = draw_pilot(scene, pixels_, limits(mean_guess), 1, k_node_counts[1], progress_);
    const PathWork work = glance_work_ = work_of(scene, glance_, 1);
    const bool spectral = on(Effects::dispersion) && user_.wavelengths_nm.empty();
    const double bands = spectral ? 4 : 1;
    BeamWork beams;
    beams.pixels = pixels_.in_picture;
    beams.bands = bands;
    beams.events_per_ray = work.events / std::max(work.rays, 1.0);
    beams.parted = work.general;
    beams.tolerance = 0.3 * tolerance_;
    const double by_paths = pixels_.in_picture * 16 * bands * price_ns(work);
    const double picture = std::min(by_paths, price_ns(beams));
    // Rays of one pilot pixel: of the cuts and effects, of the wavelengths.
    const double spectra =
        0.5 * (k_spectral_rays + k_other_spectral_rays) * finest_of_pilot(tolerance_);
    const double rays = 6 * k_pilot_rays + (spectral ? spectra : k_pilot_rays);
    const double pixel_ns = rays * std::max(price_ns(work), 1.0);
    const double affordable = std::max(k_planning_share * picture, k_planning_ns) / pixel_ns;
    const int wanted =
        static_cast<int>(std::clamp(affordable, double(least), double(k_most_pixels)));
    if (wanted > least) {
        all = stone_pixels(scene_, wanted + k_proof_pixels);
        pixels_ = all.stretch(0, static_cast<std::size_t>(wanted));
    }
    pilot_ns_ = pixel_ns * static_cast<double>(pixels_.at.size());
    // A stone of few pixels is proven at all of them.
    std::size_t first = pixels_.at.size();
    if (all.at.size() < first + k_proof_pixels) first = 0;
    if (!prover_)
        prover_.emplace(scene_, all.stretch(first, k_proof_pixels), tolerance_, progress_);
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
        if (effect != Effects::dispersion && make_plan(without).on(effect)) continue;
        line.on = false;
        line.why = k_same_light;
        line.bound = 0;
    }
    if (make_plan(with_effects(false)).splits) return;
    branches_ = !scene_.stone.convex;
}

// A depth that the scene names may be shallower than the light goes.
void Planner::bound_depth() {
    if (user_.depth == 0) return;
    const Scene scene = at_pilot_wavelengths(with_effects(false));
    PathLimits deep = limits(std::min(cut_, 0.01 * tolerance_));
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
    cut_delta_e_ += error.bound_delta_e();
}

// The largest weight that may be let go.
void Planner::choose_cut() {
    const Scene scene = at_pilot_wavelengths(with_effects(false));
    double cut = coarsest_cut();
    if (branches_) {
        // Nothing is cut: small paths gamble, and that makes noise and no bias.
        cut_ = 0;
        first_ = draw(scene, k_pilot_rays);
        work_ = whole_ = work_of(scene, first_, k_pilot_rays);
        return;
    }
    // Down by factors of three, until the next step changes little and the remainder of the steps
    // beyond is small by the brightest light, or is beyond rounding.
    const auto at = [&](double weight) {
        return draw_pilot(scene, pixels_, limits(weight), k_pilot_rays, k_node_counts[1],
                          progress_);
    };
    cuts_.clear();
    PilotDrawing coarse = at(cut);
    for (;;) {
        PilotDrawing fine = at(cut / k_cut_step);
        const ColourError error = colour_error(coarse.rgb, fine.rgb);
        // What further steps bring: each about a third of the one before.
        const double bound = 1.5 * error.bound();
        // Beforehand: what is cut at a path's end is less than the cut, and sees at most the
        // brightest light.
        const double known = fine.mean > 0 ? cut * fine.brightest / fine.mean : bound;
        for (CutChoice& coarser : cuts_) {
            coarser.error += error.radiance;
            coarser.bound += error.bound();
            coarser.bound_delta_e += error.bound_delta_e();
        }
        cuts_.push_back({cut, std::min(1.5 * error.radiance, known), std::min(bound, known),
                         1.5 * error.bound_delta_e()});
        if (bound <= k_share_of_cut * tolerance_ || cut < 1e-8) {
            first_ = std::move(fine);
            work_ = whole_ = work_of(scene, coarse, k_pilot_rays);
            first_.seconds = coarse.seconds;
            break;
        }
        coarse = std::move(fine);
        cut /= k_cut_step;
    }
    take(cuts_.back());
    // Finer ones, should a picture show that the pilot's few pixels missed what matters.
    for (int more = 0; more < k_more_cuts; ++more) {
        CutChoice finer = cuts_.back();
        for (double* part : {&finer.weight, &finer.error, &finer.bound, &finer.bound_delta_e})
            *part /= k_cut_step;
        cuts_.push_back(finer);
    }
}

void Planner::take(const CutChoice& choice) {
    cut_ = choice.weight;
    cut_error_ = choice.error;
    cut_bound_ = choice.bound;
    cut_delta_e_ = choice.bound_delta_e;
}

}  // namespace culet
