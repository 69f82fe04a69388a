#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "render/colour/colour_error.h"
#include "render/planner/planner.h"
#include "render/planner/wavelengths.h"
#include "render/setup/a_priori.h"

namespace culet {

namespace {

// Errors of causes of their own add up as squares do: of the tolerance, what all effects that are
// left out are likely off by; and what goes where an effect costs next to nothing.
constexpr double k_share_of_effects = 0.25, k_share_of_cheap = 0.05;
// Rays in each pixel of a pilot; behind a lens.
constexpr int k_lens_rays = 16;
constexpr std::size_t k_coherence_pixels = 16;
// Dispersion is looked at with so many wavelengths, in two drawings of half the pixels by other
// rays: squares that lie on a grid, and others that do not.
constexpr int k_spectral_nodes = 15;
constexpr int k_spectral_rays = 4, k_other_spectral_rays = 5;

// "Garnet (almandine), coloured" is "garnet" in a sentence.
std::string spoken(const Material& material) {
    std::string name = material.name.empty() ? material.id : material.name;
    name = name.substr(0, name.find_first_of("(,"));
    while (!name.empty() && name.back() == ' ') name.pop_back();
    if (name.empty() || name.starts_with("material of")) return "the stone";
    if (name.size() > 1 && std::islower(static_cast<unsigned char>(name[1])))
        name[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(name[0])));
    return name;
}

}  // namespace

void Planner::say_what_is_known() {
    const std::string stone = spoken(scene_.stone.material);
    const bool isotropic = scene_.stone.material.optic == OpticCharacter::isotropic;
    if (isotropic) {
        for (Effects effect : {Effects::birefringence, Effects::pleochroism, Effects::coherence})
            item(effect).why = stone + " is isotropic";
    }
    if (absorbed_across(scene_) == 0) {
        item(Effects::absorption).why = stone + " is clear";
        if (!isotropic) item(Effects::pleochroism).why = stone + " is clear: no wave is absorbed";
    } else if (!isotropic && absorbance_apart(scene_) == 0) {
        item(Effects::pleochroism).why = stone + "'s waves are absorbed alike";
    }
    if (on(Effects::birefringence)) {
        item(Effects::birefringence).why =
            fmt::format("{}'s two images lie up to {:.2g} px apart", stone, images_apart(scene_));
    }
    if (on(Effects::dispersion)) {
        const IndexSpans spans = index_spans(scene_);
        item(Effects::dispersion).why = fmt::format(
            "{}'s index changes by {:.4f}: colours leave up to {:.2g} degrees apart", stone,
            spans.dispersion, exit_deviation(spans.dispersion, spans.mean) * 57.29577951308232);
    }
    if (on(Effects::absorption)) {
        item(Effects::absorption).why = fmt::format(
            "{} takes up to {:.0f} % of the light on one "
            "way across",
            stone, 100 * absorbed_across(scene_));
    }
    if (on(Effects::pleochroism)) {
        item(Effects::pleochroism).why =
            fmt::format("{}'s waves differ by up to {:.2g} in absorbance on one way across", stone,
                        absorbance_apart(scene_));
    }
    if (on(Effects::aperture)) {
        item(Effects::aperture).why =
            fmt::format("the lens blurs points by up to {:.2g} px", aperture_blur(scene_));
    }
}

// Leaves it out where that is likely to cost less than `share` of the tolerance, with all that is
// left out already; returns whether it does.
bool Planner::leaves_out(PlanItem& line, const ColourError& error, bool exact, double bound,
                         double share) {
    line.matters = error.radiance;
    line.matters_delta_e = error.delta_e;
    const double likely = std::min(bound, error.radiance),
                 at_most = std::min(bound, error.radiance + error.radiance_spread);
    if (!user_.effects_auto || bound > tolerance_ || at_most > share * tolerance_ ||
        std::hypot(left_out_, at_most) > k_share_of_effects * tolerance_) {
        line.why += fmt::format("; without it the picture is off by {:.2g}", error.radiance);
        return false;
    }
    line.on = false;
    line.bound = bound;
    line.bound_delta_e = exact ? 0 : error.bound_delta_e();
    line.why =
        exact ? k_same_light : fmt::format("bound {:.2g} under tolerance {:g}", bound, tolerance_);
    spent_ += bound;
    left_out_ = std::hypot(left_out_, likely);
    return true;
}

// Leaves an effect out if that is likely to cost less than `share` of the tolerance.
void Planner::try_without(Effects effect, double share) {
    if (!on(effect)) return;
    PlanItem& line = item(effect);
    const int samples = on(Effects::aperture) ? k_lens_rays : k_pilot_rays;
    const Scene with = at_pilot_wavelengths(with_effects(false)),
                without = at_pilot_wavelengths(with_effects(false, effect));
    const OpticalSetup still = make_optical_setup(without);
    if (still.on(effect)) {
        line.why = still.effects[static_cast<std::size_t>(effect)].why;
        return;
    }
    const PilotDrawing there = samples == k_pilot_rays ? first_ : draw(with, samples);
    const PilotDrawing gone = draw(without, samples);
    const ColourError error = colour_error(gone.rgb, there.rgb);
    const bool exact = same_light_everywhere(scene_.lights) && !on(Effects::absorption) &&
                       effect != Effects::absorption && effect != Effects::aperture &&
                       !scene_.camera.optics.analyzer;
    double bound = exact ? 0 : error.bound();
    if (effect == Effects::absorption && there.mean > 0)
        bound = std::min(bound, absorbed_across(scene_) * there.brightest / there.mean *
                                    std::max(1.0, work_.events));
    const double price = price_ns(work_of(with, there, samples)),
                 price_without = price_ns(work_of(without, gone, samples));
    line.seconds_with = price;  // relative, until times are estimated
    line.seconds_without = price_without;
    if (!leaves_out(line, error, exact, bound, share)) return;
    first_ = gone;
    work_ = work_of(without, gone, samples);
}

// Beside the error of all else: powers that are added are what the scene says of its light, and
// interfering waves are drawn from the mean of their places, so that neither is the other's truth.
void Planner::bound_coherence() {
    PlanItem& line = item(Effects::coherence);
    if (line.on || !on(Effects::birefringence)) {
        line.bound = line.bound_delta_e = 0;
        return;
    }
    const std::string waves =
        fmt::format("one lags up to {:.2g} waves behind the other", waves_behind(scene_));
    if (same_light_everywhere(scene_.lights) && !on(Effects::absorption)) {
        line.bound = line.bound_delta_e = 0;
        line.why = fmt::format("{}; {}", k_same_light, waves);
        return;
    }
    Scene apart = at_pilot_wavelengths(with_effects(false));
    apart.settings.coherence = false;
    Scene together = apart;
    together.settings.coherence = true;
    // Every wavelength has a tree of its own where waves interfere: fewer pixels, evenly spread.
    StonePixels few;
    const std::size_t step = std::max<std::size_t>(1, pixels_.at.size() / k_coherence_pixels);
    for (std::size_t i = 0; i < pixels_.at.size(); i += step) few.at.push_back(pixels_.at[i]);
    const PilotDrawing powers = draw_pilot(apart, few, limits(), k_pilot_rays),
                       waves_met = draw_pilot(together, few, limits(), k_pilot_rays);
    const ColourError error = colour_error(powers.rgb, waves_met.rgb);
    line.seconds_without = price_ns(work_of(apart, powers, k_pilot_rays));
    line.seconds_with = price_ns(work_of(together, waves_met, k_pilot_rays)) *
                        static_cast<double>(make_optical_setup(together).bands.size());
    line.matters = error.radiance;
    line.matters_delta_e = error.delta_e;
    line.bound = error.bound();
    line.bound_delta_e = error.bound_delta_e();
    line.why += fmt::format("; {}; as interfering waves they would change the picture by {:.2g}",
                            waves, error.radiance);
}

// What the scene switches off is left out all the same: the difference to the picture with it.
void Planner::measure_what_the_scene_forbids() {
    if (user_.effects_auto || pixels_.at.empty()) return;
    Scene everything = with_effects(false);
    everything.settings.effects_auto = true;
    const OpticalSetup whole = make_optical_setup(everything);
    const Scene drawn = with_effects(false);
    // Of all wavelengths of an eye ray.
    const auto price_of = [&](const Scene& scene, const PilotDrawing& drawing, int samples) {
        const Scene piloted = at_pilot_wavelengths(scene);
        return price_ns(work_of(piloted, drawing, samples)) *
               static_cast<double>(make_optical_setup(piloted).bands.size());
    };
    const auto drawing_of = [&](const Scene& scene, int samples) {
        branches_ = paths_branch(scene);
        return draw(at_pilot_wavelengths(scene), samples);
    };
    const int samples = scene_.camera.aperture_radius > 0 ? k_lens_rays : k_pilot_rays;
    const PilotDrawing here = drawing_of(drawn, samples);
    const double price = price_of(drawn, here, samples);
    bool any = false;
    for (int e = 0; e < k_effect_count; ++e) {
        const Effects effect = static_cast<Effects>(e);
        PlanItem& line = item(effect);
        if (user_.effects[static_cast<std::size_t>(e)] || effect == Effects::coherence ||
            !whole.on(effect))
            continue;
        any = true;
        Scene with = drawn;
        auto& effects = with.settings.effects;
        effects[static_cast<std::size_t>(e)] = true;
        // Waves are absorbed unlike only where there are two of them and light is absorbed at all.
        if (effect == Effects::pleochroism) {
            effects[static_cast<std::size_t>(Effects::birefringence)] = true;
            effects[static_cast<std::size_t>(Effects::absorption)] = true;
        }
        const PilotDrawing there = drawing_of(with, samples);
        const ColourError error = colour_error(here.rgb, there.rgb);
        line.seconds_with = plan_.seconds * price_of(with, there, samples) / price;
        line.matters = error.radiance;
        line.matters_delta_e = error.delta_e;
        line.bound = error.bound();
        line.bound_delta_e = error.bound_delta_e();
        line.why = fmt::format("switched off by the scene; with it the picture differs by {:.2g}",
                               error.radiance);
    }
    if (!any) return;
    plan_.bound += colour_error(here.rgb, drawing_of(everything, samples).rgb).bound();
}

void Planner::choose_effects() {
    // The dearest first.
    const bool two_waves = on(Effects::birefringence);
    try_without(Effects::birefringence, 0.4);
    if (two_waves && !on(Effects::birefringence)) {
        for (Effects effect : {Effects::pleochroism, Effects::coherence}) {
            PlanItem& line = item(effect);
            if (effect == Effects::coherence || line.on) line.why = k_merged_waves;
            line.on = false;
        }
    }
    try_without(Effects::aperture, 0.3);
    try_without(Effects::polarization, 0.3);
    try_without(Effects::pleochroism, k_share_of_cheap);
    try_without(Effects::absorption, k_share_of_cheap);
    if (!on(Effects::absorption) && on(Effects::pleochroism)) {
        item(Effects::pleochroism).on = false;
        item(Effects::pleochroism).why = "nothing is absorbed";
    }
    bound_coherence();
}

// Colours of single rays are far stronger than those of a pixel: only what two drawings have in
// common counts. How colours spread, one wave shows as well as two, whose trees are far dearer.
void Planner::try_without_dispersion() {
    if (!on(Effects::dispersion)) return;
    PlanItem& line = item(Effects::dispersion);
    const auto spectral = [&](bool dispersion) {
        Scene scene = with_effects(dispersion);
        if (on(Effects::birefringence) && !on(Effects::coherence) && scene.stone.convex) {
            for (Effects effect : {Effects::birefringence, Effects::pleochroism})
                scene.settings.effects[static_cast<std::size_t>(effect)] = false;
        }
        if (user_.wavelengths_nm.empty())
            scene.settings.wavelengths_nm = even_wavelengths(k_spectral_nodes);
        PathLimits how = limits();
        how.roulette = paths_branch(scene);
        if (!how.roulette) how.cut_weight = k_pilot_cut * tolerance_;
        const StonePixels half = pixels_.stretch(0, (pixels_.at.size() + 1) / 2);
        const auto drawn = [&](int rays) {
            return draw_pilot(scene, half, how, rays, k_node_counts[1], progress_).rgb;
        };
        return std::array{drawn(k_spectral_rays), drawn(k_other_spectral_rays)};
    };
    const ColourError gone = error_in_common(spectral(false), spectral(true));
    line.seconds_with = 2;
    line.seconds_without = 1;
    leaves_out(line, gone, false, gone.bound(), k_share_of_effects);
}

}  // namespace culet
