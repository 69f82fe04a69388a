#include <fmt/format.h>

#include <algorithm>
#include <cmath>

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
constexpr double k_coarse_tolerance = 0.02;
// What lies beyond the finer of two sets, as a share of their difference.
// Errors fall to less than a half from one set to the next: of a set two steps below, a sixth.
constexpr double k_beyond = 0.5, k_beyond_two = 0.17;
// Of the tolerance, what paths are cut at where a crystal's waves go as one in a pilot.
constexpr double k_one_way_cut = 0.1;
// Of three standard errors, what makes an error likely.
constexpr double k_likely = 0.5;

bool is_coloured(const LightColour& light) {
    const Rgb* rgb = std::get_if<Rgb>(&light.value);
    return rgb != nullptr && !((*rgb)[0] == (*rgb)[1] && (*rgb)[1] == (*rgb)[2]);
}

// Lights whose spectra are made for the wavelengths at hand.
bool coloured(const Lights& lights) {
    return lights.environment ||
           std::any_of(lights.sources.begin(), lights.sources.end(),
                       [](const Light& light) { return is_coloured(colour_of(light)); });
}

std::array<std::vector<Rgb>, 2> colours_of(const TwoDrawings& drawn) {
    return {drawn.one.rgb, drawn.other.rgb};
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

std::size_t finest_level(double tolerance) {
    return tolerance >= k_coarse_tolerance ? k_coarse_level : k_fine_level;
}

// Where dispersion is on, the error for so few wavelengths: their directions differ by what colours
// leave apart over the number of steps. At three it was a fifth to a half of that in daylight and
// up to 0.8 in a light box, whose lights are small (diamond, spinel, cubic zirconia, glasses, YAG).
constexpr double k_colours_apart = 0.4, k_colours_power = 0.9;

}  // namespace

Scene Planner::at_glance_wavelengths(Scene scene) const {
    if (user_.wavelengths_nm.empty() && !branches_ && chose_spectrum(scene, make_plan(scene))) {
        scene.settings.wavelengths_nm = even_wavelengths(k_counts[k_fine_level]);
        return scene;
    }
    return at_pilot_wavelengths(std::move(scene));
}

// What the light's and the stone's colours are off by at so few wavelengths, the glance shows; of
// dispersion what it usually brings.
std::vector<WavelengthChoice> Planner::usual_wavelengths() const {
    const bool spectral = glance_.wavelengths_nm.size() > 3,
               exact = coloured(scene_.lights) && !on(Effects::absorption);
    const IndexSpans spans = index_spans(scene_);
    const double apart = on(Effects::dispersion)
                             ? k_colours_apart * exit_deviation(spans.dispersion, spans.mean)
                             : 0;
    std::vector<WavelengthChoice> sets;
    for (std::size_t i = 0; i < k_counts.size(); ++i) {
        const int count = k_counts[i], of_glance = k_counts[std::min(i, k_fine_level)];
        // Lights in colours bring these exactly at any wavelengths from three on.
        const double flat =
            spectral && !exact
                ? colour_error(colours_of(glance_, even_wavelengths(of_glance)), glance_.rgb)
                      .radiance
                : 0;
        sets.push_back(
            {count, std::hypot(flat, apart * std::pow(3.0 / count, k_colours_power)), 0, 0});
    }
    return sets;
}

int finest_of_pilot(double tolerance) {
    return k_counts[finest_level(tolerance)];
}

std::vector<double> even_wavelengths(int count) {
    // Few in the middle of the eye's responses rather than at the ends of the spectrum. Dispersion
    // moves lights' edges over a pixel, each wavelength's at another place: of five, these show
    // such a step of a spectrum, at any wavelength, better than even ones do, and a lamp about as
    // well.
    if (count == 3) return {450, 550, 610};
    if (count == 5) return {440, 480, 540, 600, 650};
    std::vector<double> nm;
    for (int i = 0; i < count; ++i)
        nm.push_back(k_first_nm + (k_last_nm - k_first_nm) * i / (count - 1));
    return nm;
}

int turns_for(int rays, int wavelengths) {
    return std::max(1, std::min(rays / 2, wavelengths / 4 + 1));
}

TwoDrawings Planner::draw_spectra(const Scene& scene) const {
    const StonePixels half = pixels_.stretch(0, (pixels_.at.size() + 1) / 2);
    PathLimits how = limits(cut_);
    // A single way is cut and not gambled on.
    if (branches_ && scene.stone.convex && !make_plan(scene).splits)
        how.cut_weight = k_one_way_cut * tolerance_;
    // Squares lie on a grid, others do not: patterns of their own.
    const auto draw = [&](int rays) {
        return draw_pilot(scene, half, how, rays, k_node_counts[1], progress_);
    };
    return {draw(k_spectral_rays), draw(k_other_spectral_rays)};
}

// With dispersion the reference's rays take turns with the wavelengths: many of both are needed
// anyway, and each ray at one wavelength tells as much as another. Beams are grown for each.
void Planner::choose_wavelengths() {
    PlanItem& dispersion = item(Effects::dispersion);
    const bool open = user_.wavelengths_nm.empty();
    const std::vector<int>& counts = on(Effects::coherence) ? k_coherent_counts : k_counts;
    const std::size_t level = std::min(finest_level(tolerance_), counts.size() - 1);
    // How colours spread, one wave shows as well as two, whose trees are far dearer.
    const auto as_one = [&](Scene scene) {
        if (!on(Effects::birefringence) || on(Effects::coherence) || !scene.stone.convex)
            return scene;
        for (Effects effect : {Effects::birefringence, Effects::pleochroism})
            scene.settings.effects[static_cast<std::size_t>(effect)] = false;
        return scene;
    };
    const auto finest = [&](Scene scene) {
        if (open) scene.settings.wavelengths_nm = even_wavelengths(counts[level]);
        return scene;
    };
    Scene flat = as_one(with_effects(false));
    const Scene whole = finest(as_one(with_effects(on(Effects::dispersion))));
    const Plan flat_plan = make_plan(flat);
    const bool flat_spectrum = open && chose_spectrum(flat, flat_plan);
    const std::size_t bands = make_plan(whole).bands.size();
    dispersed_ = (on(Effects::dispersion) || on(Effects::coherence)) && bands > 1;
    whole_bands_ = dispersed_ ? (open ? k_node_counts[2] : static_cast<double>(bands)) : 1;
    if (dispersed_) {
        const TwoDrawings fine = draw_spectra(whole);
        if (on(Effects::dispersion)) {
            if (flat_spectrum) flat = finest(flat);
            const ColourError gone =
                error_in_common(colours_of(draw_spectra(flat)), colours_of(fine));
            dispersion.matters = gone.radiance;
            dispersion.matters_delta_e = gone.delta_e;
            dispersion.seconds_with = 2;
            dispersion.seconds_without = 1;
            if (user_.effects_auto &&
                may_go(gone.bound(), gone.radiance + gone.radiance_spread, k_share_of_effects)) {
                dispersion.on = false;
                dispersion.bound = gone.bound();
                dispersion.bound_delta_e = gone.bound_delta_e();
                dispersion.why =
                    fmt::format("bound {:.2g} under tolerance {:g}", gone.bound(), tolerance_);
                leave_out(gone.bound(), gone.radiance);
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
    const Scene all = finest(as_one(with_effects(false)));
    settle_wavelengths(all, counts, level, draw_spectra(all));
}

void Planner::settle_wavelengths(Scene pilot, const std::vector<int>& counts, std::size_t level,
                                 const TwoDrawings& fine) {
    const bool anew = coloured(scene_.lights);
    const auto error_of = [&](std::size_t i) {
        pilot.settings.wavelengths_nm = even_wavelengths(counts[i]);
        const std::vector<double>& nm = pilot.settings.wavelengths_nm;
        std::array<std::vector<Rgb>, 2> seen;
        if (!anew) seen = {colours_of(fine.one, nm), colours_of(fine.other, nm)};
        if (seen[0].empty()) seen = colours_of(draw_spectra(pilot));
        return error_in_common(seen, colours_of(fine));
    };
    spectrum_ = true;
    sets_.clear();
    const auto offer = [&](std::size_t i, const ColourError& error, double factor) {
        sets_.push_back({counts[i], factor * error.radiance, factor * error.bound(),
                         factor * error.bound_delta_e()});
    };
    // Down from the finest, until the colours are others than asked for.
    for (std::size_t i = level; i-- > 0;) {
        const ColourError here = error_of(i);
        if (i + 1 == level) {
            // What lies beyond the finest is less than to it.
            for (std::size_t finer = counts.size(); --finer > level;)
                offer(finer, here, std::pow(k_beyond_two, static_cast<double>(finer - level)));
            offer(level, here, k_beyond);
        }
        offer(i, here, 1 + (i + 1 == level ? k_beyond : k_beyond_two));
        if (here.radiance > tolerance_) break;
    }
    // The finished picture is held against the truth: likely is enough.
    const WavelengthChoice* chosen = &sets_.front();
    for (const WavelengthChoice& set : sets_) {
        const double likely = set.error + k_likely * (set.bound - set.error);
        if (likely > k_share_of_wavelengths * tolerance_) break;
        chosen = &set;
    }
    take(*chosen);
}

void Planner::take(const WavelengthChoice& set) {
    if (set.count == 0) return;
    plan_.settings.wavelengths_nm = even_wavelengths(set.count);
    wavelength_bound_ = set.bound;
    wavelength_delta_e_ = set.bound_delta_e;
}

}  // namespace culet
