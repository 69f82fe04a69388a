#include <fmt/format.h>

#include <algorithm>

#include "render/colour_error.h"
#include "render/plan/a_priori.h"
#include "render/plan/planner.h"

namespace culet {

namespace {

constexpr double k_first_nm = 410, k_last_nm = 690;
// Sets to choose from. All but the finest are part of that of 29, all but that of 5 of that of 15.
const std::vector<int> k_counts{3, 5, 8, 15, 29, 57}, k_coherent_counts{29, 57};
// What the sets are held against: finer where less is allowed.
constexpr std::size_t k_coarse_level = 3, k_fine_level = 4;
constexpr double k_coarse_tolerance = 0.05;
// What lies beyond the finer of two sets, as a share of their difference.
// Errors fall to less than a half from one set to the next: of a set two steps below, a sixth.
constexpr double k_beyond = 0.5, k_beyond_two = 0.17;

constexpr int k_fine_rays = 36;
// Of what nine rays are off by without dispersion, what so many are off by at the least.
constexpr double k_of_more_rays = 0.5;

bool is_coloured(const LightColour& light) {
    const Rgb* rgb = std::get_if<Rgb>(&light.value);
    return rgb != nullptr && !((*rgb)[0] == (*rgb)[1] && (*rgb)[1] == (*rgb)[2]);
}

// Lights whose spectra are made for the wavelengths at hand.
bool coloured(const Lights& lights) {
    const auto any = [](const auto& list) {
        return std::any_of(list.begin(), list.end(),
                           [](const auto& light) { return is_coloured(light.radiance); });
    };
    return lights.environment || any(lights.spheres) || any(lights.lobes) ||
           any(lights.hemispheres) || any(lights.caps) || any(lights.planes);
}

// Colours of a drawing's pixels from some of its wavelengths alone; empty: it has not all of them.
std::vector<Rgb> colours_of(const PilotDrawing& drawing, const std::vector<double>& nm) {
    std::vector<std::size_t> at;
    for (double wanted : nm) {
        const auto found =
            std::find_if(drawing.wavelengths_nm.begin(), drawing.wavelengths_nm.end(),
                         [&](double there) { return std::abs(there - wanted) < 1e-6; });
        if (found == drawing.wavelengths_nm.end()) return {};
        at.push_back(static_cast<std::size_t>(found - drawing.wavelengths_nm.begin()));
    }
    const WavelengthSet colours(nm);
    std::vector<Rgb> rgb;
    std::vector<double> radiance(nm.size());
    for (std::size_t p = 0; p < drawing.rgb.size(); ++p) {
        for (std::size_t i = 0; i < at.size(); ++i)
            radiance[i] = drawing.spectra[p * drawing.wavelengths_nm.size() + at[i]];
        rgb.push_back(colours.rgb_of(radiance.data()));
    }
    return rgb;
}

}  // namespace

std::vector<double> even_wavelengths(int count) {
    // Three in the middle of the eye's responses rather than at the ends of the spectrum.
    if (count == 3) return {450, 550, 610};
    std::vector<double> nm;
    for (int i = 0; i < count; ++i)
        nm.push_back(k_first_nm + (k_last_nm - k_first_nm) * i / (count - 1));
    return nm;
}

int turns_for(int rays, int wavelengths) {
    return std::max(1, std::min(rays / 2, wavelengths / 4 + 1));
}

double Planner::room_for_wavelengths() const {
    return std::max(k_share_of_wavelengths * tolerance_, 0.5 * (tolerance_ - 2 * spent_));
}

PilotDrawing Planner::draw_spectra(const Scene& scene, int samples) const {
    return draw_pilot(scene, pixels_.stretch(0, (pixels_.at.size() + 3) / 4), limits(cut_), samples,
                      k_node_counts[1], progress_);
}

// Colours of single rays are far stronger than those of their mean: where a few rays leave it open,
// more of them decide.
ColourError Planner::dispersion_gone(Scene whole, Scene flat, const PilotDrawing& fine,
                                     double allowed) const {
    const ColourError gone = colour_error(draw_spectra(flat, k_spectral_rays).rgb, fine.rgb);
    const bool open = gone.bound() > allowed && k_of_more_rays * gone.radiance <= allowed;
    if (!open || !user_.effects_auto) return gone;
    // In turns, as the reference draws them.
    whole.settings.wavelength_turns =
        turns_for(k_fine_rays, static_cast<int>(make_plan(whole).bands.size()));
    return colour_error(draw_spectra(flat, k_fine_rays).rgb, draw_spectra(whole, k_fine_rays).rgb);
}

// With dispersion the reference's rays take turns with the wavelengths: many of both are needed
// anyway, and each ray at one wavelength tells as much as another. Beams are grown for each.
void Planner::choose_wavelengths() {
    PlanItem& dispersion = item(Effects::dispersion);
    const bool open = user_.wavelengths_nm.empty();
    const std::vector<int>& counts = on(Effects::coherence) ? k_coherent_counts : k_counts;
    const std::size_t level = std::min(
        tolerance_ >= k_coarse_tolerance ? k_coarse_level : k_fine_level, counts.size() - 1);
    const auto finest = [&](Scene scene) {
        if (open) scene.settings.wavelengths_nm = even_wavelengths(counts[level]);
        return scene;
    };
    Scene flat = with_effects(false);
    const Scene whole = finest(with_effects(on(Effects::dispersion)));
    const Plan flat_plan = make_plan(flat);
    const bool flat_spectrum = open && chose_spectrum(flat, flat_plan);
    const std::size_t bands = make_plan(whole).bands.size();
    dispersed_ = (on(Effects::dispersion) || on(Effects::coherence)) && bands > 1;
    whole_bands_ = dispersed_ ? (open ? k_node_counts[2] : static_cast<double>(bands)) : 1;
    if (dispersed_) {
        const PilotDrawing fine = draw_spectra(whole, k_spectral_rays);
        if (on(Effects::dispersion)) {
            if (flat_spectrum) flat = finest(flat);
            const double allowed = k_share_of_effects * tolerance_ - spent_;
            const ColourError gone = dispersion_gone(whole, flat, fine, allowed);
            dispersion.matters = gone.radiance;
            dispersion.matters_delta_e = gone.delta_e;
            dispersion.seconds_with = 2;
            dispersion.seconds_without = 1;
            if (user_.effects_auto && gone.bound() <= allowed) {
                dispersion.on = false;
                dispersion.bound = gone.bound();
                dispersion.bound_delta_e = gone.bound_delta_e();
                dispersion.why =
                    fmt::format("bound {:.2g} under tolerance {:g}", gone.bound(), tolerance_);
                spent_ += gone.bound();
                dispersed_ = on(Effects::coherence);
            } else {
                dispersion.why +=
                    fmt::format("; without it the picture is off by {:.2g}", gone.radiance);
            }
        }
        if (dispersed_ && open) settle_wavelengths(whole, counts, level, fine);
    }
    if (!open || dispersed_) return;
    if (!flat_spectrum) {
        plan_.settings.wavelengths_nm = flat_plan.wavelengths_nm;
        return;
    }
    const Scene all = finest(with_effects(false));
    settle_wavelengths(all, counts, level, draw_spectra(all, k_spectral_rays));
}

void Planner::settle_wavelengths(Scene pilot, const std::vector<int>& counts, std::size_t level,
                                 const PilotDrawing& fine) {
    const bool anew = coloured(scene_.lights);
    const auto error_of = [&](std::size_t i) {
        pilot.settings.wavelengths_nm = even_wavelengths(counts[i]);
        std::vector<Rgb> seen;
        if (!anew) seen = colours_of(fine, pilot.settings.wavelengths_nm);
        if (seen.empty()) seen = draw_spectra(pilot, k_spectral_rays).rgb;
        return colour_error(seen, fine.rgb);
    };
    spectrum_ = true;
    std::size_t chosen = level;
    ColourError error;
    double factor = 1 + k_beyond;
    for (std::size_t i = level; i-- > 0;) {
        const ColourError here = error_of(i);
        factor = 1 + (i + 1 == level ? k_beyond : k_beyond_two);
        // The finished picture is held against the truth: likely is enough, as long as the sum of
        // all bounds stays below the tolerance.
        const double likely = factor * (here.radiance + 1.5 * here.radiance_spread);
        if (likely > room_for_wavelengths() || spent_ + factor * here.bound() > tolerance_) {
            factor = 1 + (chosen + 1 == level ? k_beyond : k_beyond_two);
            if (chosen < level) break;
            // Not even the next coarser set: what lies beyond the finest is less than to it.
            error = here;
            factor = k_beyond;
            break;
        }
        chosen = i;
        error = here;
    }
    if (chosen == level && level + 1 < counts.size() &&
        factor * error.bound() > room_for_wavelengths()) {
        // Finer than what it was held against.
        ++chosen;
        factor = k_beyond_two;
    }
    plan_.settings.wavelengths_nm = even_wavelengths(counts[chosen]);
    wavelength_bound_ = factor * error.bound();
    wavelength_delta_e_ = factor * error.bound_delta_e();
    // The reference's rays take turns with more wavelengths than these.
    if (!dispersed_) spent_ += wavelength_bound_;
}

int Planner::next_wavelength_count(int count) {
    const auto next = std::upper_bound(k_counts.begin(), k_counts.end(), count);
    return next == k_counts.end() ? k_counts.back() : *next;
}

}  // namespace culet
