#include "render/plan/planner.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "render/colour_error.h"

namespace culet {

namespace {

constexpr double k_unknown = std::numeric_limits<double>::quiet_NaN();

// Wavelengths that pilots of effects are drawn at: three carry any colour of light.
const std::vector<double> k_pilot_nm{450, 550, 610};
constexpr int k_least_pixels = 48, k_most_pixels = 400;
// Of the picture's price that a plan may cost, and what it may cost in any case.
constexpr double k_planning_share = 0.04, k_planning_ns = 1.5e6;
// Trees that branch: far below the noise of a pixel's few rays, and half as dear as following
// paths of a tenth of these weights.
constexpr double k_split_weight = 0.1, k_gambled_weight = 0.01;

}  // namespace

Planner::Planner(const Scene& whole)
    : scene_(whole), user_(whole.settings), tolerance_(whole.settings.tolerance) {
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
}

ScenePlan Planner::run(bool everything) {
    const auto start = std::chrono::steady_clock::now();
    say_what_is_known();
    if (tolerance_ > 0) pixels_ = stone_pixels(scene_, k_least_pixels);
    if (pixels_.at.empty()) {
        settle_without_pilot();
    } else {
        choose_pixels();
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
        estimate_times();
    }
    for (int e = 0; e < k_effect_count; ++e)
        plan_.settings.effects[static_cast<std::size_t>(e)] =
            plan_.items[static_cast<std::size_t>(e)].on;
    plan_.reference.effects = plan_.settings.effects;
    add_resolutions();
    plan_.bound = spent_;
    if (everything) measure_what_the_scene_forbids();
    for (const PlanItem& line : plan_.items) {
        // Whether waves interfere is a matter of the light, which the scene settles.
        if (line.name != name_of(Effects::coherence)) plan_.bound_delta_e += line.bound_delta_e;
    }
    plan_.seconds_planning =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return std::move(plan_);
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

PilotDrawing Planner::draw(const Scene& scene, int samples) const {
    return draw_pilot(scene, pixels_, limits(cut_), samples);
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
    const Scene scene = at_pilot_wavelengths(with_effects(false));
    const double mean_guess = std::max(tolerance_ * 0.1, 1e-4);
    const PilotDrawing glance = draw_pilot(scene, pixels_, limits(mean_guess), 1);
    const PathWork work = work_of(scene, glance, 1);
    const bool spectral = on(Effects::dispersion) && user_.wavelengths_nm.empty();
    const double bands = spectral ? 4 : 1;
    BeamWork beams;
    beams.pixels = pixels_.in_picture;
    beams.bands = bands;
    beams.events_per_ray = work.events / std::max(work.rays, 1.0);
    const double by_paths = pixels_.in_picture * 16 * bands * price_ns(work);
    const double picture = work.general ? by_paths : std::min(by_paths, price_ns(beams));
    // Rays of one pilot pixel: of the cuts and effects, of the wavelengths, of the samples.
    const double rays = 4 * 8 + (spectral ? 4 * (36 + 16) + 16 : 8) + 20;
    const double affordable = std::max(k_planning_share * picture, k_planning_ns) /
                              (rays * std::max(price_ns(work), 1.0));
    const int wanted =
        static_cast<int>(std::clamp(affordable, double(k_least_pixels), double(k_most_pixels)));
    if (wanted > static_cast<int>(pixels_.at.size())) pixels_ = stone_pixels(scene_, wanted);
}

// The largest weight that may be let go.
void Planner::choose_cut() {
    const Scene scene = at_pilot_wavelengths(with_effects(false));
    double cut = std::min(0.25 * tolerance_, 0.02);
    if (branches_) {
        // Nothing is cut: small paths gamble, and that makes noise and no bias.
        cut_ = k_gambled_weight;
        first_ = draw(scene, k_pilot_rays);
        work_ = whole_ = work_of(scene, first_, k_pilot_rays);
        return;
    }
    // Down by factors of four, until the next step changes little and the remainder of the steps
    // beyond is small by the brightest light, or is beyond rounding.
    const auto at = [&](double weight) {
        return draw_pilot(scene, pixels_, limits(weight), k_pilot_rays);
    };
    PilotDrawing coarse = at(cut);
    for (;;) {
        PilotDrawing fine = at(cut / 4);
        const ColourError error = colour_error(coarse.rgb, fine.rgb);
        // What further steps bring: each about a third of the one before.
        const double bound = 1.5 * error.bound();
        if (bound <= k_share_of_cut * tolerance_ || cut < 1e-8) {
            cut_ = cut;
            // Beforehand: what is cut at a path's end is less than the cut, and sees at most the
            // brightest light.
            const double known = fine.mean > 0 ? cut * fine.brightest / fine.mean : bound;
            cut_bound_ = std::min(bound, known);
            cut_delta_e_ = 1.5 * error.bound_delta_e();
            first_ = std::move(fine);
            work_ = whole_ = work_of(scene, coarse, k_pilot_rays);
            first_.seconds = coarse.seconds;
            break;
        }
        coarse = std::move(fine);
        cut /= 4;
    }
    spent_ += cut_bound_;
}

}  // namespace culet
