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
// What lies beyond the finer of two sets, as a share of their difference.
constexpr double k_beyond = 0.5;

std::vector<double> nodes_of(int count) {
    // Three in the middle of the eye's responses rather than at the ends of the spectrum.
    if (count == 3) return {450, 550, 610};
    std::vector<double> nm;
    for (int i = 0; i < count; ++i)
        nm.push_back(k_first_nm + (k_last_nm - k_first_nm) * i / (count - 1));
    return nm;
}

// The scene at ever more wavelengths.
class Spectra {
public:
    template <class Draw>
    Spectra(const std::vector<int>& counts, std::size_t first_level, double room, const Draw& draw)
        : level_(std::min(first_level, counts.size() - 1)), drawings_(counts.size()) {
        const auto at = [&](std::size_t i) -> const PilotDrawing& {
            if (drawings_[i].rgb.empty()) drawings_[i] = draw(nodes_of(counts[i]));
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
        nodes = nodes_of(counts[chosen_]);
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

void Planner::choose_wavelengths() {
    if (!user_.wavelengths_nm.empty()) return;
    RenderSettings& settings = plan_.settings;
    PlanItem& dispersion = item(Effects::dispersion);
    const Scene flat = with_effects(false);
    const Plan flat_plan = make_plan(flat);
    const bool flat_spectrum = chose_spectrum(flat, flat_plan);
    const auto draw_at = [&](Scene scene, const std::vector<double>& nm) {
        scene.settings.wavelengths_nm = nm;
        return draw(scene, k_spectral_rays);
    };
    if (on(Effects::dispersion) && user_.effects_auto && same_light_everywhere(scene_.lights) &&
        !on(Effects::absorption)) {
        dispersion.on = false;
        dispersion.why = k_same_light;
    }
    whole_bands_ = on(Effects::dispersion) ? k_node_counts[2] : 1;
    if (!on(Effects::dispersion) && !flat_spectrum) {
        settings.wavelengths_nm = flat_plan.wavelengths_nm;
        return;
    }
    const double room =
        0.5 * std::max(k_share_of_wavelengths * tolerance_, tolerance_ - 2 * spent_);
    const bool coherent = on(Effects::coherence);
    const std::vector<int>& counts = coherent ? k_coherent_counts : k_counts;
    const Scene coloured = with_effects(on(Effects::dispersion));
    const Spectra spectra(counts, k_first_level, room,
                          [&](const std::vector<double>& nm) { return draw_at(coloured, nm); });
    if (on(Effects::dispersion)) {
        const std::vector<double>& nm = flat_spectrum ? spectra.nodes : flat_plan.wavelengths_nm;
        const ColourError gone = colour_error(draw_at(flat, nm).rgb, spectra.truth().rgb);
        const double bound = (1 + k_beyond) * gone.bound();
        dispersion.matters = gone.radiance;
        dispersion.matters_delta_e = gone.delta_e;
        dispersion.seconds_with = static_cast<double>(spectra.nodes.size());
        dispersion.seconds_without = 1;
        if (user_.effects_auto && spent_ + bound <= k_share_of_effects * tolerance_) {
            dispersion.on = false;
            dispersion.bound = bound;
            dispersion.bound_delta_e = (1 + k_beyond) * gone.bound_delta_e();
            dispersion.why = fmt::format("bound {:.2g} under tolerance {:g}", bound, tolerance_);
            spent_ += bound;
            settings.wavelengths_nm = nm;
            return;
        }
        dispersion.why += fmt::format("; without it the picture is off by {:.2g}", gone.radiance);
    }
    spectrum_ = true;
    settings.wavelengths_nm = spectra.nodes;
    wavelength_bound_ = spectra.factor * spectra.error.bound();
    wavelength_delta_e_ = spectra.factor * spectra.error.bound_delta_e();
    spent_ += wavelength_bound_;
}

}  // namespace culet
