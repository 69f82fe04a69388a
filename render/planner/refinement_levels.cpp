#include "render/planner/refinement_levels.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "render/beams/frame_renderer.h"
#include "render/engine/engine.h"
#include "render/planner/cause_pilot.h"
#include "render/planner/wavelengths.h"
#include "render/setup/a_priori.h"

namespace culet {

namespace {

// Of the tolerance, what the next picture aims at: the nearer to it, the more pixels of the truth
// it takes to tell that it is reached. And what its wavelengths and its cut paths may bring.
constexpr double k_aim = 0.5, k_share_of_wavelengths = 0.35, k_share_of_cut = 0.2;
constexpr double k_cut_step = 3;
// Borders of the coarsest beams, and what a preview is off by over these. Errors of borders fall as
// the root of their tolerance (docs/rendering.md).
constexpr double k_coarsest = 0.1, k_finest = 1e-6, k_beams_over_preview = 0.25;
// A step goes no further than this: what few pixels show may be chance; and not less far.
constexpr double k_longest_step = 0.1, k_least_step_of_borders = 0.4;
// Prices rise about as these powers; and by this from a preview to beams.
constexpr double k_price_of_borders = 0.4, k_price_of_cut = 0.25, k_price_of_parted_cut = 0.85,
                 k_price_over_preview = 2.2;
// A crystal's beams are cut, without roulette: at 0.009 that left 0.047 of the light, which is to
// be 0.4 of the tolerance.
constexpr double k_crystal_power = 0.6, k_coarsest_crystal_cut = 0.03;
// Colours of a path leave apart by an angle; so much of it is what three wavelengths are off by,
// and more are by their number to this power (diamond, spinel, cubic zirconia, glasses, YAG in four
// lights).
constexpr double k_colours_apart = 0.3, k_colours_power = 0.9;
// The same of a sun, whose images hardly any pixel shows; and what these may bring.
constexpr double k_sun_apart = 0.8, k_share_of_sun = 0.2;
// Of the truth's noise, what an error must be to be seen in it.
constexpr double k_seen_in_noise = 0.5;
// Pixels of the estimate that tell causes apart.
constexpr std::size_t k_pixels_of_causes = 192;
constexpr int k_most_side = 40, k_pupil_points = 16, k_most_pupil_points = 256;
// What the mean of N rays is off by falls about as N to this power.
constexpr double k_power_of_rays = 0.7;

// With which the rays of a pixel take turns. A few rays that the time allows would carry many each;
// a few that the scene asks for do.
int nodes_for(int rays, bool asked_for) {
    if (asked_for) return rays < 36 ? 29 : 57;
    return rays < 4 ? 3 : rays < 9 ? 8 : rays < 36 ? 29 : 57;
}

}  // namespace

RefinementLevels::RefinementLevels(const Scene& scene, const ScenePlan& plan,
                                   ErrorEstimator& estimator, const Progress& progress)
    : scene_(scene),
      plan_(plan),
      estimator_(estimator),
      progress_(progress),
      setup_(make_optical_setup(with_effects())),
      doubles_(paths_branch(scene, setup_)) {}

Scene RefinementLevels::with_effects() const {
    Scene scene = scene_;
    scene.settings.effects_auto = false;
    scene.settings.effects = plan_.settings.effects;
    return scene;
}

bool RefinementLevels::wavelengths_are_open() const {
    return scene_.settings.wavelengths_nm.empty() && chose_spectrum(scene_, setup_);
}

// Rays a pixel, where `rays` were off by `off` and may be by `room`.
int RefinementLevels::rays_to_reach(double room, int rays, double off) const {
    const double wanted = rays * std::pow(off / room, 1 / k_power_of_rays);
    int side =
        std::clamp(static_cast<int>(std::ceil(std::sqrt(std::min(wanted, 1e6)))), 1, k_most_side);
    while (ErrorEstimator::takes_grid(side)) ++side;
    return side * side;
}

RefinementLevel RefinementLevels::first() const {
    const RenderSettings& user = scene_.settings;
    const std::string refused = engine_named(k_beam_engine).refuses(scene_, setup_);
    RefinementLevel level;
    if (user.engine == k_reference_engine || (user.engine == k_auto_engine && !refused.empty())) {
        level = by_reference(nullptr);
        level.why = refused;
    } else {
        level = first_beams();
        level.why = "the coarsest that can do; finer ones, or the reference, where the check asks";
    }
    if (user.engine != k_auto_engine) level.why = "as the scene says";
    return level;
}

RefinementLevel RefinementLevels::first_beams() const {
    const RenderSettings& user = scene_.settings;
    const double tolerance = user.tolerance;
    RefinementLevel level{.settings = with_effects().settings};
    RenderSettings& settings = level.settings;
    // A preview has one colour a region: of a map that is seldom near enough.
    const bool preview =
        user.engine == k_preview_engine ||
        (user.engine == k_auto_engine && !setup_.splits && !scene_.lights.environment);
    settings.engine = preview ? k_preview_engine : k_beam_engine;
    settings.tolerance = k_coarsest;
    settings.cut_weight = std::min(0.3, tolerance);
    if (setup_.splits && settings.crystal_beams != CrystalBeams::merged) {
        settings.tolerance = std::clamp(tolerance, 1e-3, k_coarsest);
        settings.cut_weight = std::min(
            k_coarsest_crystal_cut, 0.009 * std::pow(0.4 * tolerance / 0.047, 1 / k_crystal_power));
    }
    settings.split_weight = settings.cut_weight;
    if (user.wavelengths_nm.empty()) settings.wavelengths_nm = setup_.wavelengths_nm;
    if (wavelengths_are_open()) {
        settings.wavelengths_nm = even_wavelengths(setup_.on(Effects::coherence)   ? 29
                                                   : tolerance >= k_fine_tolerance ? 3
                                                                                   : 5);
    }
    if (setup_.on(Effects::aperture) && user.samples == 0)
        settings.samples =
            std::clamp(static_cast<int>(3 / tolerance), k_pupil_points, k_most_pupil_points);
    DrawingWork work;
    work.pixels = plan_.pixels;
    work.views = setup_.on(Effects::aperture) ? settings.samples : 1;
    work.bands = static_cast<double>(
        std::min(setup_.bands.size(), std::max<std::size_t>(1, settings.wavelengths_nm.size())));
    work.faces_per_ray = plan_.events_per_ray;
    work.tolerance = settings.tolerance;
    work.cut = *settings.cut_weight;
    work.polarised = setup_.polarised;
    work.splits = setup_.splits;
    level.price_ns = engine_named(settings.engine).cost_ns(work);
    return level;
}

// Of these wavelengths each ray of a pixel carries some. With dispersion many of both are needed
// anyway, and each ray at one wavelength tells as much as another.
void RefinementLevels::set_rays(RefinementLevel& level, int rays) const {
    RenderSettings& settings = level.settings;
    const std::size_t before = settings.wavelengths_nm.size();
    settings.samples = rays;
    if (wavelengths_are_open())
        settings.wavelengths_nm = even_wavelengths(
            std::max(nodes_for(rays, scene_.settings.samples > 0), static_cast<int>(before)));
    const bool dispersed = (setup_.on(Effects::dispersion) || setup_.on(Effects::coherence)) &&
                           setup_.bands.size() > 1;
    const auto wavelengths = static_cast<double>(settings.wavelengths_nm.size());
    // Each by itself; the truth's rays take turns as well.
    double bands = 1;
    if (dispersed) {
        settings.wavelength_turns = turns_for(rays, static_cast<int>(wavelengths));
        bands = wavelengths / *settings.wavelength_turns / estimator_.bands_of_a_ray();
    }
    level.price_ns = plan_.pixels * rays * bands * estimator_.pixel_ns() / estimator_.samples();
}

RefinementLevel RefinementLevels::by_reference(const ErrorEstimate* estimate) const {
    const RenderSettings& user = scene_.settings;
    const double tolerance = user.tolerance;
    RefinementLevel level{.settings = with_effects().settings};
    RenderSettings& settings = level.settings;
    settings.engine = k_reference_engine;
    settings.cut_weight = doubles_ ? tree_cut(tolerance) : 0.1 * tolerance;
    settings.split_weight = tree_split(tolerance);
    // The estimate has seen more of what few rays are off by.
    const double noise =
        std::max(estimate != nullptr ? estimate->noise : estimator_.noise_of_16(), 1e-9);
    const int rays = estimate != nullptr ? estimate->samples : 16;
    if (!wavelengths_are_open() && user.wavelengths_nm.empty())
        settings.wavelengths_nm = setup_.wavelengths_nm;
    set_rays(level,
             user.samples > 0 ? user.samples : rays_to_reach(k_aim * tolerance, rays, noise));
    level.noise = noise * std::pow(static_cast<double>(rays) / settings.samples, k_power_of_rays);
    level.why = "beams would take longer";
    return level;
}

RefinementLevel RefinementLevels::more_rays(const RefinementLevel& level,
                                            const ErrorEstimate& estimate) const {
    const int rays = level.settings.samples;
    RefinementLevel more = level;
    set_rays(more, std::max(rays_to_reach(k_aim * scene_.settings.tolerance, rays,
                                          estimate.error() + 2 * estimate.spread),
                            rays_to_reach(1, rays, 1.3)));
    more.noise *= std::pow(static_cast<double>(more.settings.samples) / rays, -k_power_of_rays);
    more.why =
        fmt::format("{} rays a pixel were off by {:.2g}: drawn with more", rays, estimate.bound);
    return more;
}

bool RefinementLevels::fit(RefinementLevel& level, double allowed_ns) const {
    const int wanted = level.settings.samples;
    while (level.price_ns > allowed_ns) {
        int side = static_cast<int>(std::sqrt(level.settings.samples)) - 1;
        while (ErrorEstimator::takes_grid(side)) --side;
        if (scene_.settings.samples > 0 || side < 1) return false;
        // Fewer rays carry fewer wavelengths.
        if (wavelengths_are_open()) level.settings.wavelengths_nm.clear();
        set_rays(level, side * side);
        level.why =
            fmt::format("the time allows {} rays a pixel of {}", level.settings.samples, wanted);
    }
    return true;
}

bool RefinementLevels::too_few(int wavelengths) const {
    if (!wavelengths_are_open() || !setup_.on(Effects::dispersion)) return false;
    const IndexSpans spans = index_spans(scene_);
    const bool sun = estimator_.sees_sun();
    const double apart = (sun ? k_sun_apart : k_colours_apart) *
                         exit_deviation(spans.dispersion, spans.mean) *
                         std::pow(3.0 / wavelengths, k_colours_power);
    return wavelengths < k_wavelength_counts.back() &&
           apart > (sun ? k_share_of_sun : k_share_of_wavelengths) * scene_.settings.tolerance;
}

bool RefinementLevels::may_miss_the_sun(const RenderSettings& settings) const {
    if (!estimator_.sees_sun()) return false;
    return (settings.engine == k_preview_engine && scene_.settings.engine == k_auto_engine) ||
           too_few(static_cast<int>(settings.wavelengths_nm.size()));
}

// What they bring in the picture as it is.
double RefinementLevels::finer_wavelengths(RefinementLevel& level, CausePilot& pilot,
                                           bool again) const {
    if (!wavelengths_are_open()) return 0;
    const double allowed = k_share_of_wavelengths * scene_.settings.tolerance;
    std::vector<double>& nm = level.settings.wavelengths_nm;
    const int before = static_cast<int>(nm.size());
    double brought = -1;
    for (const int count : k_wavelength_counts) {
        if (count < before) continue;
        // The same as the truth's, or finer.
        const double error =
            count >= pilot.wavelengths() ? 0 : pilot.at_wavelengths(even_wavelengths(count));
        if (brought < 0) brought = error;
        nm = even_wavelengths(count);
        if (again && count == before) continue;
        // What is less than the truth's noise is not seen: there colours apart tell.
        const bool small = error <= std::max(allowed, k_seen_in_noise * pilot.noise());
        if ((small || again) && !too_few(count)) break;
    }
    level.price_ns *= static_cast<double>(nm.size()) / before;
    return brought;
}

double RefinementLevels::finer_cut(RefinementLevel& level, CausePilot& pilot) const {
    RenderSettings& settings = level.settings;
    const double before = *settings.cut_weight, tolerance = scene_.settings.tolerance;
    double brought = -1;
    for (double cut = before; cut > pilot.least_cut(); cut /= k_cut_step) {
        const double error = pilot.at_cut(cut);
        if (brought < 0) brought = error;
        settings.cut_weight = settings.split_weight = cut;
        if (error <= k_share_of_cut * tolerance) break;
    }
    level.price_ns *= std::pow(before / *settings.cut_weight, k_price_of_cut);
    return std::max(brought, 0.0);
}

double RefinementLevels::finer_borders(RefinementLevel& level, double off_by) const {
    const double aim = k_aim * scene_.settings.tolerance;
    RenderSettings& settings = level.settings;
    double factor = 1, price = 1;
    if (settings.engine == k_preview_engine && scene_.settings.engine != k_preview_engine) {
        settings.engine = k_beam_engine;
        price = k_price_over_preview;
        const double left = k_beams_over_preview * off_by;
        if (left > aim) factor = std::max(std::pow(aim / left, 2), 0.3 * k_longest_step);
    } else {
        factor = std::clamp(std::pow(aim / std::max(off_by, 1e-12), 2), k_longest_step,
                            k_least_step_of_borders);
    }
    settings.tolerance = std::max(k_finest, factor * settings.tolerance);
    if (setup_.on(Effects::aperture) && scene_.settings.samples == 0) {
        // Points of the pupil fill the rest.
        settings.samples = std::min(2 * settings.samples, k_most_pupil_points);
        price *= 2;
    }
    return price * std::pow(factor, -k_price_of_borders);
}

RefinementLevel RefinementLevels::finer_beams(const RefinementLevel& level,
                                              const ErrorEstimate& estimate, bool again) const {
    const double aim = k_aim * scene_.settings.tolerance, off_by = estimate.seen();
    RefinementLevel finer = level;
    CausePilot pilot(
        estimator_.scene(), level.settings,
        estimator_.sample(std::min(static_cast<std::size_t>(estimate.pixels), k_pixels_of_causes)),
        progress_);
    const double of_wavelengths = finer_wavelengths(finer, pilot, again);
    double of_cut = 0;
    if (doubles_) {
        const double factor = std::clamp(std::pow(aim / off_by, 1 / k_crystal_power),
                                         k_longest_step, k_least_step_of_borders);
        finer.settings.cut_weight = *finer.settings.cut_weight * factor;
        finer.price_ns *= std::pow(factor, -k_price_of_parted_cut);
    } else {
        of_cut = finer_cut(finer, pilot);
    }
    // Causes of their own add up as squares do.
    const double of_borders = std::sqrt(
        std::max(0.0, off_by * off_by - of_wavelengths * of_wavelengths - of_cut * of_cut));
    const bool same = finer.settings.wavelengths_nm == level.settings.wavelengths_nm &&
                      finer.settings.cut_weight == level.settings.cut_weight;
    if (of_borders > aim || same || again) finer.price_ns *= finer_borders(finer, of_borders);
    finer.why = fmt::format("{} came to within {:.2g} only: drawn with finer beams",
                            level.settings.engine, estimate.bound);
    return finer;
}

std::optional<RefinementLevel> RefinementLevels::after(const RefinementLevel& level,
                                                       const ErrorEstimate& estimate,
                                                       bool again) const {
    const RenderSettings& user = scene_.settings;
    if (!drawn_by_beams(level.settings)) {
        if (user.samples > 0 || level.settings.samples >= k_most_side * k_most_side)
            return std::nullopt;
        return more_rays(level, estimate);
    }
    RefinementLevel finer = finer_beams(level, estimate, again);
    if (user.engine != k_auto_engine) return finer;
    RefinementLevel reference = by_reference(&estimate);
    if (finer.price_ns <= reference.price_ns) return finer;
    reference.why = fmt::format("beams came to within {:.2g} only: drawn by the reference instead",
                                estimate.bound);
    return reference;
}

}  // namespace culet
