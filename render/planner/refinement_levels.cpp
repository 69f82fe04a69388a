#include "render/planner/refinement_levels.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "render/beams/frame_renderer.h"
#include "render/engine/engine.h"
#include "render/planner/policy.h"
#include "render/planner/wavelengths.h"
#include "render/setup/a_priori.h"

namespace culet {

RefinementLevels::RefinementLevels(const Scene& scene, const ScenePlan& plan,
                                   ErrorEstimator& estimator)
    : scene_(scene),
      plan_(plan),
      estimator_(estimator),
      setup_(make_optical_setup(with_effects())),
      branches_(paths_branch(scene, setup_)) {}

Scene RefinementLevels::with_effects() const {
    Scene scene = scene_;
    scene.settings.effects_auto = false;
    scene.settings.effects = plan_.settings.effects;
    return scene;
}

bool RefinementLevels::wavelengths_are_open() const {
    return scene_.settings.wavelengths_nm.empty() && chose_spectrum(scene_, setup_);
}

RefinementLevel RefinementLevels::first() const {
    const RenderSettings& user = scene_.settings;
    const std::string refused = engine_named(k_beam_engine).refuses(scene_, setup_);
    RefinementLevel level;
    if (user.engine == k_reference_engine || (user.engine == k_auto_engine && !refused.empty())) {
        level = reference_by_noise(1, estimator_.noise_of_16(), 16);
        level.why = refused;
    } else {
        level = beams(0);
        level.why = "the coarsest that can do; finer ones, or the reference, where the check asks";
    }
    if (user.engine != k_auto_engine) level.why = "as the scene says";
    return level;
}

RefinementLevel RefinementLevels::beams(int number) const {
    const RenderSettings& user = scene_.settings;
    RefinementLevel level{.number = number, .settings = with_effects().settings};
    RenderSettings& settings = level.settings;
    // A preview has one colour per region, which is rarely close enough for a map.
    const bool preview =
        user.engine == k_preview_engine || (number == 0 && user.engine == k_auto_engine &&
                                            !setup_.splits && !scene_.lights.environment);
    settings.engine = preview ? k_preview_engine : k_beam_engine;
    double borders = k_coarsest, paths = std::min(0.3, user.tolerance);
    if (setup_.splits && settings.crystal_beams != CrystalBeams::merged) {
        borders = std::clamp(user.tolerance, 1e-3, k_coarsest);
        paths = std::min(0.03, k_crystal_cut * std::pow(user.tolerance, 1 / k_crystal_power));
    }
    settings.tolerance = std::max(1e-6, borders * std::pow(k_finer_borders, number));
    settings.cut_weight = settings.split_weight = paths * std::pow(k_finer_paths, number);
    std::vector<double>& nm = settings.wavelengths_nm;
    if (user.wavelengths_nm.empty()) nm = setup_.wavelengths_nm;
    if (wavelengths_are_open()) {
        const int least = setup_.on(Effects::coherence)        ? 29
                          : user.tolerance >= k_fine_tolerance ? 3
                                                               : 5;
        auto count = std::find(k_wavelength_counts.begin(), k_wavelength_counts.end(), least);
        count += std::min<long>(number, k_wavelength_counts.end() - 1 - count);
        while (number > 0 && too_few(*count)) ++count;
        nm = even_wavelengths(*count);
    }
    const bool lens = setup_.on(Effects::aperture);
    // Points of the pupil fill a pixel.
    if (lens && user.samples == 0)
        settings.samples = std::min(256, std::max(16, static_cast<int>(3 / user.tolerance))
                                             << std::min(number, 4));
    DrawingWork work;
    work.pixels = plan_.pixels;
    work.views = lens ? settings.samples : 1;
    work.bands = setup_.bands.size() > 1 ? static_cast<double>(nm.size()) : 1;
    work.faces_per_ray = plan_.events_per_ray;
    work.tolerance = settings.tolerance;
    work.cut = *settings.cut_weight;
    work.polarised = setup_.polarised;
    work.splits = setup_.splits;
    level.price_ns =
        engine_named(settings.engine).cost_ns(work) / (preview ? k_price_over_preview : 1);
    return level;
}

// `noise`: the error of `rays` rays.
RefinementLevel RefinementLevels::reference(int number, double noise, int rays) const {
    const RenderSettings& user = scene_.settings;
    const ReferenceLevel& of_series = k_reference_levels[static_cast<std::size_t>(number)];
    RefinementLevel level{.number = number, .settings = with_effects().settings};
    RenderSettings& settings = level.settings;
    settings.engine = k_reference_engine;
    settings.cut_weight = branches_ ? tree_cut(user.tolerance) : 0.1 * user.tolerance;
    settings.split_weight = tree_split(user.tolerance);
    int wavelengths = of_series.wavelengths;
    settings.samples = of_series.rays;
    if (user.samples > 0) {
        settings.samples = user.samples;
        wavelengths = user.samples < 36 ? 29 : 57;
    }
    std::vector<double>& nm = settings.wavelengths_nm;
    if (user.wavelengths_nm.empty()) nm = setup_.wavelengths_nm;
    if (wavelengths_are_open()) nm = even_wavelengths(wavelengths);
    // Each ray carries some of the wavelengths: dispersion needs many rays and wavelengths anyway,
    // and a ray at one wavelength tells as much as at another.
    double bands = 1;
    if ((setup_.on(Effects::dispersion) || setup_.on(Effects::coherence)) &&
        setup_.bands.size() > 1) {
        settings.wavelength_turns = turns_for(settings.samples, static_cast<int>(nm.size()));
        bands = static_cast<double>(nm.size()) / *settings.wavelength_turns;
    }
    level.price_ns = plan_.pixels * settings.samples * bands * estimator_.band_ns();
    level.noise = std::max(noise, 1e-9) *
                  std::pow(static_cast<double>(rays) / settings.samples, k_power_of_rays);
    level.why = "beams would take longer";
    return level;
}

// The coarsest level from `least` on with a likely error below half the tolerance.
RefinementLevel RefinementLevels::reference_by_noise(int least, double noise, int rays) const {
    const int last = static_cast<int>(k_reference_levels.size()) - 1;
    RefinementLevel level = reference(least, noise, rays);
    while (level.noise > k_aim * scene_.settings.tolerance && level.number < last)
        level = reference(level.number + 1, noise, rays);
    return level;
}

std::optional<RefinementLevel> RefinementLevels::within(const RefinementLevel& level,
                                                        double allowed_ns) const {
    RefinementLevel found = level;
    while (found.price_ns > allowed_ns) {
        if (scene_.settings.samples > 0 || found.number == 0) return std::nullopt;
        found = reference(found.number - 1, level.noise, level.settings.samples);
        found.why = fmt::format("the time allows {} rays a pixel of {}", found.settings.samples,
                                level.settings.samples);
    }
    return found;
}

// Whether so many wavelengths leave gaps between a sun's images.
bool RefinementLevels::too_few(int wavelengths) const {
    if (!estimator_.sees_sun() || !wavelengths_are_open() || !setup_.on(Effects::dispersion))
        return false;
    const IndexSpans spans = index_spans(scene_);
    const double apart = k_sun_apart * exit_deviation(spans.dispersion, spans.mean) *
                         std::pow(3.0 / wavelengths, 0.9);
    return wavelengths < k_wavelength_counts.back() &&
           apart > k_share_of_sun * scene_.settings.tolerance;
}

bool RefinementLevels::may_miss_the_sun(const RenderSettings& settings) const {
    if (!estimator_.sees_sun()) return false;
    return (settings.engine == k_preview_engine && scene_.settings.engine == k_auto_engine) ||
           too_few(static_cast<int>(settings.wavelengths_nm.size()));
}

std::optional<RefinementLevel> RefinementLevels::after(const RefinementLevel& level,
                                                       const ErrorEstimate& estimate) const {
    const RenderSettings& user = scene_.settings;
    if (!drawn_by_beams(level.settings)) {
        const int rays = level.settings.samples, next = level.number + 1;
        if (user.samples > 0 || next == static_cast<int>(k_reference_levels.size()))
            return std::nullopt;
        RefinementLevel more =
            reference_by_noise(next, estimate.error() + 2 * estimate.standard_error, rays);
        more.why = fmt::format("{} rays a pixel were off by {:.2g}: drawn with more", rays,
                               estimate.bound);
        return more;
    }
    const bool preview = level.number == 0 && level.settings.engine == k_preview_engine &&
                         user.engine != k_preview_engine;
    const double too_much = estimate.seen() / (k_aim * user.tolerance);
    // Few pixels may show too much by chance.
    const int steps = preview ? 1
                              : static_cast<int>(std::clamp(std::ceil(std::log2(too_much)), 1.0,
                                                            1.0 * k_most_levels_at_once));
    RefinementLevel finer = beams(level.number + steps);
    // Scale by this level's actual price.
    finer.price_ns *= level.price_ns / beams(level.number).price_ns;
    finer.why = fmt::format("{} came to within {:.2g} only: drawn with finer beams",
                            level.settings.engine, estimate.bound);
    // A sun's images fill few pixels, and few rays miss them where beams do not. So the check's few
    // pixels do not show the reference's noise (garnet in daylight: 4 s instead of 2 s).
    if (user.engine != k_auto_engine || (estimator_.sees_sun() && !branches_)) return finer;
    // The estimate's noise comes from more pixels than the first look.
    RefinementLevel by_rays = reference_by_noise(1, estimate.noise, estimate.samples);
    if (finer.price_ns <= by_rays.price_ns) return finer;
    by_rays.why = fmt::format("beams came to within {:.2g} only: drawn by the reference instead",
                              estimate.bound);
    return by_rays;
}

}  // namespace culet
