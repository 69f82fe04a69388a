#include <fmt/format.h>

#include <algorithm>

#include "render/colour_error.h"
#include "render/plan/a_priori.h"
#include "render/plan/planner.h"

namespace culet {

void Planner::choose_wavelengths() {
    RenderSettings& settings = plan_.settings;
    PlanItem& dispersion = item(Effects::dispersion);
    if (!user_.wavelengths_nm.empty()) return;
    const auto colourless = [&](bool dispersive) {
        Scene scene = with_effects(dispersive);
        scene.settings.wavelengths_nm.clear();
        return scene;
    };
    const Scene flat = colourless(false);
    const Plan flat_plan = make_plan(flat);
    const bool flat_spectrum = chose_spectrum(flat, flat_plan);
    whole_bands_ = on(Effects::dispersion) ? k_node_counts[2] : 1;
    if (!on(Effects::dispersion) && !flat_spectrum) {
        settings.wavelengths_nm = flat_plan.wavelengths_nm;
        return;
    }
    // Everything that comes in colours, at ever more wavelengths, until more change little.
    const bool exact = same_light_everywhere(scene_.lights) && !on(Effects::absorption);
    const double room =
        std::max(k_share_of_wavelengths, 1 - 2 * spent_ / tolerance_) * tolerance_ / 2;
    const bool coherent = on(Effects::coherence);
    const std::vector<int> counts =
        coherent ? std::vector<int>{29, 57} : std::vector<int>{3, 5, 8, 15, 29, 57};
    const auto nodes_of = [](int count) -> std::vector<double> {
        // Three in the middle of the eye's responses rather than at the ends of the spectrum.
        if (count == 3) return {450, 550, 610};
        std::vector<double> nm;
        for (int i = 0; i < count; ++i) nm.push_back(410 + 280.0 * i / (count - 1));
        return nm;
    };
    const auto drawn = [&](int count, bool dispersive) {
        Scene scene = colourless(dispersive);
        scene.settings.wavelengths_nm = nodes_of(count);
        return draw(scene, k_pilot_rays);
    };
    if (on(Effects::dispersion) && exact && user_.effects_auto) {
        dispersion.on = false;
        dispersion.why = "the light is the same from everywhere: nothing changes";
        settings.wavelengths_nm = flat_plan.wavelengths_nm;
        return;
    }
    const bool dispersive = on(Effects::dispersion);
    std::size_t chosen = counts.size() - 1, level = coherent ? 1 : 3;
    std::vector<PilotDrawing> drawings(counts.size());
    const auto at = [&](std::size_t i) -> const PilotDrawing& {
        if (drawings[i].rgb.empty()) drawings[i] = drawn(counts[i], dispersive);
        return drawings[i];
    };
    ColourError error;
    for (;; ++level) {
        // What lies beyond the finest of these: about half of the last step.
        bool found = false;
        for (std::size_t i = level; i-- > 0;) {
            const ColourError here = colour_error(at(i).rgb, at(level).rgb);
            if (1.5 * here.bound() > room) break;
            chosen = i;
            error = here;
            found = true;
        }
        if (found || level + 1 == counts.size()) break;
    }
    if (chosen == counts.size() - 1) {
        error = colour_error(at(chosen - 1).rgb, at(chosen).rgb);
        error.radiance /= 3;
        error.radiance_spread /= 3;
    }
    double bound = 1.5 * error.bound();
    if (dispersive) {
        const PilotDrawing& truth = at(std::min(level, counts.size() - 1));
        Scene scene = flat;
        if (flat_spectrum) scene.settings.wavelengths_nm = nodes_of(counts[chosen]);
        const PilotDrawing without = draw(scene, k_pilot_rays);
        const ColourError gone = colour_error(without.rgb, truth.rgb);
        dispersion.matters = gone.radiance;
        dispersion.matters_delta_e = gone.delta_e;
        const double bands = static_cast<double>(counts[chosen]);
        dispersion.seconds_with = bands;
        dispersion.seconds_without = 1;
        if (user_.effects_auto && 1.5 * gone.bound() + spent_ <= k_share_of_effects * tolerance_) {
            dispersion.on = false;
            dispersion.bound = 1.5 * gone.bound();
            dispersion.bound_delta_e = 1.5 * gone.bound_delta_e();
            dispersion.why =
                fmt::format("bound {:.2g} under tolerance {:g}", dispersion.bound, tolerance_);
            spent_ += dispersion.bound;
            settings.wavelengths_nm = scene.settings.wavelengths_nm.empty()
                                          ? flat_plan.wavelengths_nm
                                          : scene.settings.wavelengths_nm;
            return;
        }
        dispersion.why += fmt::format("; without it the picture is off by {:.2g}", gone.radiance);
    }
    spectrum_ = true;
    settings.wavelengths_nm = nodes_of(counts[chosen]);
    spent_ += bound;
    wavelength_bound_ = bound;
    wavelength_delta_e_ = 1.5 * error.bound_delta_e();
}

}  // namespace culet
