#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "render/colour_error.h"
#include "render/plan/a_priori.h"
#include "render/plan/planner.h"

namespace culet {

namespace {

// "Garnet (almandine), coloured" is "garnet" in a sentence.
std::string spoken(const Material& material) {
    std::string name = material.name.empty() ? material.id : material.name;
    name = name.substr(0, name.find_first_of("(,"));
    while (!name.empty() && name.back() == ' ') name.pop_back();
    if (name.empty()) return "the stone";
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
    if (!on(Effects::absorption) && scene_.stone.material.absorption_per_mm[0].max() == 0)
        item(Effects::absorption).why = stone + " is clear";
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

// Leaves an effect out if that costs less than `share` of the tolerance.
void Planner::try_without(Effects effect, double share) {
    if (!on(effect)) return;
    PlanItem& line = item(effect);
    const int samples = on(Effects::aperture) ? k_lens_rays : k_pilot_rays;
    const Scene with = at_pilot_wavelengths(with_effects(false)),
                without = at_pilot_wavelengths(with_effects(false, effect));
    const Plan still = make_plan(without);
    if (still.on(effect)) {
        line.why = still.effects[static_cast<std::size_t>(effect)].why;
        return;
    }
    const PilotDrawing there = samples == k_pilot_rays ? first_ : draw(with, samples);
    const PilotDrawing gone = draw(without, samples);
    const ColourError error = colour_error(gone.rgb, there.rgb);
    line.matters = error.radiance;
    line.matters_delta_e = error.delta_e;
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
    if (!user_.effects_auto || bound > share * tolerance_ ||
        spent_ + bound > k_share_of_effects * tolerance_) {
        line.why += fmt::format("; without it the picture is off by {:.2g}", error.radiance);
        return;
    }
    line.on = false;
    line.bound = bound;
    line.bound_delta_e = exact ? 0 : error.bound_delta_e();
    line.why =
        exact ? k_same_light : fmt::format("bound {:.2g} under tolerance {:g}", bound, tolerance_);
    spent_ += bound;
    first_ = gone;
    work_ = work_of(without, gone, samples);
}

void Planner::choose_effects() {
    // The dearest first.
    try_without(Effects::birefringence, 0.4);
    try_without(Effects::aperture, 0.3);
    try_without(Effects::polarization, 0.15);
    try_without(Effects::pleochroism, k_share_of_cheap);
    try_without(Effects::absorption, k_share_of_cheap);
    if (!on(Effects::absorption) && on(Effects::pleochroism)) {
        item(Effects::pleochroism).on = false;
        item(Effects::pleochroism).why = "nothing is absorbed";
    }
    if (!on(Effects::birefringence)) {
        for (Effects effect : {Effects::pleochroism, Effects::coherence}) {
            PlanItem& line = item(effect);
            if (!line.on) continue;
            line.on = false;
            line.why = "the two waves go as one";
        }
    }
}

}  // namespace culet
