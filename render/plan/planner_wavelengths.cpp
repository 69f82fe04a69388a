#include <fmt/format.h>

#include <algorithm>

#include "render/colour_error.h"
#include "render/plan/a_priori.h"
#include "render/plan/planner.h"

namespace culet {

namespace {

constexpr double k_first_nm = 410, k_last_nm = 690;
// Finer than this nothing is looked at; it starts with the first that is not coarse.
const std::vector<int> k_counts{3, 5, 8, 15, 29, 57}, k_coherent_counts{29, 57};
constexpr std::size_t k_first_level = 3;
constexpr int k_fine_rays = 36;
// Of the difference of 16 and 36 rays, what is the 16's.
constexpr double k_of_sixteen = 0.85;
// What lies beyond the finer of two sets, as a share of their difference.
constexpr double k_beyond = 0.5;

// The scene at ever more wavelengths.
class Spectra {
public:
    template <class Draw>
    Spectra(const std::vector<int>& counts, std::size_t first_level, double room, const Draw& draw)
        : level_(std::min(first_level, counts.size() - 1)), drawings_(counts.size()) {
        const auto at = [&](std::size_t i) -> const PilotDrawing& {
            if (drawings_[i].rgb.empty()) drawings_[i] = draw(even_wavelengths(counts[i]));
            return drawings_[i];
        };
        // The coarsest whose colours are near those of the level; a finer level where none is.
        for (;; ++level_) {
            chosen_ = level_;
            for (std::size_t i = level_; i-- > 0;) {
                const ColourError here = colour_error(at(i).rgb, at(level_).rgb);
                if ((1 + k_beyond) * here.bound() > room) break;
                chosen_ = i;
                error = here;
            }
            if (chosen_ < level_ || level_ + 1 == counts.size()) break;
        }
        factor = 1 + k_beyond;
        if (chosen_ == level_) {
            error = colour_error(at(level_ - 1).rgb, at(level_).rgb);
            factor = k_beyond;
        }
        nodes = even_wavelengths(counts[chosen_]);
    }
    const PilotDrawing& truth() const { return drawings_[level_]; }

    std::vector<double> nodes;  // chosen
    ColourError error;          // times `factor`
    double factor = 1;

private:
    std::size_t level_ = 0, chosen_ = 0;
    std::vector<PilotDrawing> drawings_;
};

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
    return 0.5 * std::max(k_share_of_wavelengths * tolerance_, tolerance_ - 2 * spent_);
}

// With dispersion the rays of a pixel take turns with the wavelengths: many of both are needed
// anyway, and each ray at one wavelength tells as much as another.
void Planner::choose_wavelengths() {
    PlanItem& dispersion = item(Effects::dispersion);
    if (on(Effects::dispersion) && user_.effects_auto && same_light_everywhere(scene_.lights) &&
        !on(Effects::absorption)) {
        dispersion.on = false;
        dispersion.why = k_same_light;
    }
    const bool open = user_.wavelengths_nm.empty();
    const auto finest = [&](Scene scene) {
        if (open) scene.settings.wavelengths_nm = even_wavelengths(k_counts.back());
        return scene;
    };
    Scene flat = with_effects(false), coloured = finest(with_effects(on(Effects::dispersion)));
    const Plan flat_plan = make_plan(flat);
    const bool flat_spectrum = open && chose_spectrum(flat, flat_plan);
    const std::size_t bands = make_plan(coloured).bands.size();
    dispersed_ = (on(Effects::dispersion) || on(Effects::coherence)) && bands > 1;
    whole_bands_ = dispersed_ ? (open ? k_node_counts[2] : static_cast<double>(bands)) : 1;
    if (dispersed_) {
        coloured.settings.wavelength_turns = turns_for(k_fine_rays, k_counts.back());
        const PilotDrawing fine = draw(coloured, k_fine_rays);
        Scene rough = coloured;
        if (open) rough.settings.wavelengths_nm = even_wavelengths(29);
        rough.settings.wavelength_turns = turns_for(k_lens_rays, 29);
        const ColourError noise = colour_error(draw(rough, k_lens_rays).rgb, fine.rgb);
        noise_ = {k_lens_rays, k_of_sixteen * likely(noise), k_of_sixteen * noise.bound_delta_e(),
                  0.6};
        if (on(Effects::dispersion)) {
            if (flat_spectrum) flat = finest(flat);
            const ColourError gone = colour_error(draw(flat, k_lens_rays).rgb, fine.rgb);
            dispersion.matters = gone.radiance;
            dispersion.matters_delta_e = gone.delta_e;
            dispersion.seconds_with = 2;
            dispersion.seconds_without = 1;
            if (user_.effects_auto && spent_ + gone.bound() <= k_share_of_effects * tolerance_) {
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
    }
    if (!open || dispersed_) return;
    if (!flat_spectrum) {
        plan_.settings.wavelengths_nm = flat_plan.wavelengths_nm;
        return;
    }
    settle_wavelengths(with_effects(false), k_counts, k_counts.size() - 1, k_pilot_rays);
}

void Planner::settle_wavelengths(Scene pilot, const std::vector<int>& counts,
                                 std::size_t first_level, int rays) {
    const Spectra spectra(counts, first_level, room_for_wavelengths(),
                          [&](const std::vector<double>& nm) {
                              pilot.settings.wavelengths_nm = nm;
                              return draw(pilot, rays);
                          });
    spectrum_ = true;
    plan_.settings.wavelengths_nm = spectra.nodes;
    wavelength_bound_ = spectra.factor * spectra.error.bound();
    wavelength_delta_e_ = spectra.factor * spectra.error.bound_delta_e();
    spent_ += wavelength_bound_;
}

// Beams are grown for every wavelength.
void Planner::choose_beam_wavelengths() {
    settle_wavelengths(with_effects(on(Effects::dispersion)),
                       on(Effects::coherence) ? k_coherent_counts : k_counts, k_first_level,
                       k_spectral_rays);
}

}  // namespace culet
