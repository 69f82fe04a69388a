#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "render/planner/planner.h"
#include "render/planner/policy.h"
#include "render/planner/wavelengths.h"
#include "render/setup/a_priori.h"

namespace culet {

// The scene with the effects that are on, except `less`.
Scene Planner::with_effects(std::initializer_list<Effects> less) const {
    Scene scene = scene_;
    RenderSettings& settings = scene.settings;
    settings.effects_auto = false;
    for (std::size_t e = 0; e < k_effect_count; ++e) settings.effects[e] = plan_.items[e].on;
    for (Effects effect : less) settings.effects[static_cast<std::size_t>(effect)] = false;
    return scene;
}

// Without dispersion; three wavelengths then represent any colour.
Scene Planner::piloted(std::initializer_list<Effects> less) const {
    Scene scene = with_effects(less);
    scene.settings.effects[static_cast<std::size_t>(Effects::dispersion)] = false;
    std::vector<double>& nm = scene.settings.wavelengths_nm;
    if (nm.empty()) nm = k_three_nm;
    if (nm.size() > 3) nm = {nm.front(), nm[nm.size() / 2], nm.back()};
    return scene;
}

PathLimits Planner::limits() const {
    PathLimits limits;
    limits.seed = user_.seed;
    limits.depth = user_.depth > 0 ? user_.depth : k_deepest;
    limits.cut_weight = branches_ ? k_pilot_roulette : k_pilot_cut * tolerance_;
    limits.split_weight = 10 * k_pilot_roulette;
    limits.roulette = branches_;
    limits.alike = true;
    return limits;
}

PilotDrawing Planner::draw(const Scene& scene) const {
    return draw_pilot(scene, pixels_, limits(), rays_, k_node_counts[1], progress_);
}

double Planner::price_of(const Scene& scene, const PilotDrawing& drawing) const {
    PathWork work = work_along_paths(make_optical_setup(scene));
    work.rays = drawing.rays;
    work.events = drawing.events;
    return price_ns(work) / static_cast<double>(std::max<std::size_t>(1, drawing.rgb.size()));
}

Planner::Pilot Planner::pilot(const Scene& with, const Scene& without,
                              std::optional<PilotDrawing> drawn) const {
    Pilot pilot;
    pilot.with = drawn ? std::move(*drawn) : draw(with);
    pilot.without = draw(without);
    pilot.error = colour_error(pilot.without.rgb, pilot.with.rgb);
    pilot.price_with = price_of(with, pilot.with);
    pilot.price_without = price_of(without, pilot.without);
    return pilot;
}

// Stores prices in the seconds fields until times are estimated.
void Planner::write(const Pilot& pilot, PlanItem& line) const {
    line.matters = pilot.error.radiance;
    line.matters_delta_e = pilot.error.delta_e;
    line.bound = pilot.error.bound();
    line.bound_delta_e = pilot.error.bound_delta_e();
    line.seconds_with = pilot.price_with;
    line.seconds_without = pilot.price_without;
}

void Planner::try_without(Effects effect, double share) {
    PlanItem& line = item(effect);
    if (!line.on) return;
    if (effect == Effects::dispersion) {
        const ColourError error = dispersion_error();
        line.seconds_with = 2;
        line.seconds_without = 1;
        return decide(line, error, error.bound(), share);
    }
    const Scene without = piloted({effect});
    const OpticalSetup still = make_optical_setup(without);
    if (still.on(effect)) {
        line.why = still.effects[static_cast<std::size_t>(effect)].why;
        return;
    }
    Pilot pilot = this->pilot(piloted(), without, first_);
    double bound = pilot.error.bound();
    if (effect == Effects::absorption && first_.mean > 0)
        bound = std::min(bound, absorbed_across(scene_) * first_.brightest / first_.mean *
                                    std::max(1.0, first_.events / std::max(first_.rays, 1e-9)));
    line.seconds_with = pilot.price_with;
    line.seconds_without = pilot.price_without;
    decide(line, pilot.error, bound, share);
    if (!line.on) first_ = std::move(pilot.without);
}

// Dispersion: single rays have far stronger colours than a pixel. So only the common part of two
// drawings with different rays counts, one of them not on a square grid. One wave shows the
// dispersion as well as two, whose trees are far more expensive.
ColourError Planner::dispersion_error() const {
    const StonePixels half = pixels_.range(0, (pixels_.at.size() + 1) / 2);
    const auto spectral = [&](Scene scene) {
        auto& effects = scene.settings.effects;
        if (on(Effects::birefringence) && !on(Effects::coherence) && scene.stone.convex)
            effects[static_cast<std::size_t>(Effects::birefringence)] =
                effects[static_cast<std::size_t>(Effects::pleochroism)] = false;
        if (user_.wavelengths_nm.empty())
            scene.settings.wavelengths_nm = even_wavelengths(k_spectral_nodes);
        PathLimits how = limits();
        how.roulette = paths_branch(scene);
        if (!how.roulette) how.cut_weight = k_pilot_cut * tolerance_;
        const auto drawn = [&](int rays) {
            return draw_pilot(scene, half, how, rays, k_node_counts[1], progress_).rgb;
        };
        return std::array{drawn(k_pilot_rays), drawn(k_pilot_rays + 1)};
    };
    return noise_corrected_error(spectral(with_effects({Effects::dispersion})),
                                 spectral(with_effects({})));
}

// Independent errors add in quadrature.
void Planner::decide(PlanItem& line, const ColourError& error, double bound, double share) {
    line.matters = error.radiance;
    line.matters_delta_e = error.delta_e;
    const double at_most = std::min(bound, error.radiance + error.radiance_spread);
    if (!user_.effects_auto || bound > tolerance_ || at_most > share * tolerance_ ||
        std::hypot(left_out_, at_most) > k_share_of_effects * tolerance_) {
        line.why += fmt::format("; without it the picture is off by {:.2g}", error.radiance);
        return;
    }
    line.on = false;
    line.bound = bound;
    line.bound_delta_e = error.bound_delta_e();
    line.why = fmt::format("bound {:.2g} under tolerance {:g}", bound, tolerance_);
    plan_.bound += bound;
    left_out_ = std::hypot(left_out_, std::min(bound, error.radiance));
}

// Not part of the total error: the scene decides whether powers or amplitudes add, and interfering
// waves are drawn at their mean position, so neither picture is the other's reference.
void Planner::bound_coherence() {
    PlanItem& line = item(Effects::coherence);
    line.bound = line.bound_delta_e = 0;
    if (line.on || !on(Effects::birefringence)) return;
    const std::string waves =
        fmt::format("one lags up to {:.2g} waves behind the other", retardation_in_waves(scene_));
    if (same_light_everywhere(scene_.lights) && !on(Effects::absorption)) {
        line.why = fmt::format("{}; {}", k_same_light, waves);
        return;
    }
    // With interference each wavelength has its own tree: use fewer pixels, evenly spread.
    const StonePixels all = pixels_;
    pixels_.at.clear();
    const std::size_t step = std::max<std::size_t>(1, all.at.size() / k_coherence_pixels);
    for (std::size_t i = 0; i < all.at.size(); i += step) pixels_.at.push_back(all.at[i]);
    Scene together = piloted(), apart = piloted();
    together.settings.coherence = true;
    apart.settings.coherence = false;
    write(pilot(together, apart, {}), line);
    pixels_ = all;
    line.why += fmt::format("; {}; as interfering waves they would change the picture by {:.2g}",
                            waves, line.matters);
}

// The depth that the scene names may cut off light.
void Planner::bound_depth() {
    if (user_.depth == 0) return;
    PathLimits deep = limits();
    if (!branches_) deep.cut_weight = k_truth_cut * tolerance_;
    const auto at = [&](int depth) {
        deep.depth = depth;
        return draw_pilot(piloted(), pixels_, deep, k_pilot_rays, k_node_counts[1], progress_);
    };
    const PilotDrawing cut_short = at(user_.depth), whole = at(k_deepest);
    plan_.bound_of_depth = colour_error(cut_short.rgb, whole.rgb).bound();
    // A-priori bound: light beyond that depth sees at most the brightest light.
    if (!branches_ && whole.mean > 0)
        plan_.bound_of_depth =
            std::min(plan_.bound_of_depth, cut_short.remainder * whole.brightest / whole.mean);
}

// Measures effects that the scene switches off, against the picture with them.
void Planner::measure_disabled_effects() {
    const Scene drawn = piloted();
    Scene everything = drawn;
    everything.settings.effects_auto = true;
    const OpticalSetup whole = make_optical_setup(everything);
    const auto held_against = [&](const Scene& with) {
        branches_ = paths_branch(with);
        return pilot(with, drawn, {});
    };
    bool any = false;
    for (int e = 0; e < k_effect_count; ++e) {
        const Effects effect = static_cast<Effects>(e);
        if (user_.effects[static_cast<std::size_t>(e)] || effect == Effects::coherence ||
            !whole.on(effect))
            continue;
        any = true;
        Scene with = drawn;
        auto& effects = with.settings.effects;
        effects[static_cast<std::size_t>(e)] = true;
        // Pleochroism needs two waves and absorption.
        if (effect == Effects::pleochroism)
            effects[static_cast<std::size_t>(Effects::birefringence)] =
                effects[static_cast<std::size_t>(Effects::absorption)] = true;
        PlanItem& line = item(effect);
        write(held_against(with), line);
        line.seconds_with = plan_.seconds * line.seconds_with / line.seconds_without;
        line.seconds_without = plan_.seconds;
        line.why = fmt::format("switched off by the scene; with it the picture differs by {:.2g}",
                               line.matters);
    }
    if (any) plan_.bound += held_against(everything).error.bound();
}

}  // namespace culet
