#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "render/beams/beam_picture.h"
#include "render/colour_error.h"
#include "render/plan/planner.h"

namespace culet {

namespace {

// Of the difference of four and sixteen rays, what is the four's.
constexpr double k_of_four = 0.94;
// Beams of a round brilliant in a light with sharp edges were off by 1 to 3 over the root of its
// pixels.
constexpr double k_beam_error = 3;
constexpr int k_most_side = 40;  // of the grid of rays in a pixel
// What beams are held against may be off by this share of what is left of the tolerance, and cost
// this share of the picture.
constexpr double k_check_noise = 0.3, k_check_price = 0.3;
constexpr int k_least_checked = 64, k_most_checked = 400;

bool hard_edged(const Lights& lights) {
    return !lights.spheres.empty() || !lights.hemispheres.empty() || !lights.caps.empty() ||
           !lights.planes.empty();
}

}  // namespace

int rays_to_reach(double room, int rays, double off) {
    constexpr double k_power = 0.7;
    const double wanted = rays * std::pow(off / room, 1 / k_power);
    const int side = static_cast<int>(std::ceil(std::sqrt(std::min(wanted, 1e6))));
    return std::min(side, k_most_side) * std::min(side, k_most_side);
}

double Planner::Noise::at(double count) const {
    return radiance * std::pow(rays / count, power);
}

int Planner::samples_for(double room) const {
    for (int side = 1; side < k_most_side; ++side) {
        if (noise_.at(side * side) <= room) return side * side;
    }
    return k_most_side * k_most_side;
}

void Planner::choose_engine_and_samples() {
    RenderSettings& settings = plan_.settings;
    settings.cut_weight = limits(cut_).cut_weight;
    settings.split_weight = limits(cut_).split_weight;
    plan_.mean_radiance = first_.mean;
    plan_.pilot_pixels = static_cast<int>(pixels_.at.size());
    if (!dispersed_) {
        const Scene flat = at_pilot_wavelengths(with_effects(false));
        const ColourError noise = colour_error(draw(flat, 4).rgb, draw(flat, 16).rgb);
        noise_ = {4, k_of_four * likely(noise), k_of_four * noise.bound_delta_e(), 0.7};
    }
    const bool open = user_.wavelengths_nm.empty();
    const double room = std::max(tolerance_ - spent_, 0.25 * tolerance_);
    RenderSettings& reference = plan_.reference;
    reference = settings;
    reference.engine = "reference";
    reference.samples = user_.samples > 0 ? user_.samples : samples_for(room);
    double bands = 1, bands_of_ray = 1;
    if (dispersed_) {
        if (open) {
            const bool few = reference.samples <= 4 && !on(Effects::coherence);
            reference.wavelengths_nm = even_wavelengths(few                      ? 15
                                                        : reference.samples < 36 ? 29
                                                                                 : 57);
        }
        bands = static_cast<double>(reference.wavelengths_nm.size());
        reference.wavelength_turns =
            turns_for(reference.samples, static_cast<int>(reference.wavelengths_nm.size()));
        bands_of_ray = bands / reference.wavelength_turns;
    } else {
        Scene drawn = with_effects(false);
        drawn.settings.wavelengths_nm = settings.wavelengths_nm;
        const Plan plan = make_plan(drawn);
        bands = bands_of_ray = static_cast<double>(plan.bands.size());
        work_.nodes = plan.bands.front().count;
    }
    if (dispersed_) work_.nodes = 1;
    const double by_paths = pixels_.in_picture * reference.samples * bands_of_ray * price_ns(work_);

    // Beams: what they are off by falls with the size of the picture; at the least so much.
    BeamWork beams;
    beams.pixels = pixels_.in_picture;
    beams.bands = dispersed_ ? std::min(bands, tolerance_ < 0.02 ? 29.0 : 8.0) : bands;
    beams.nodes = work_.nodes;
    beams.polarised = work_.polarised;
    beams.events_per_ray = work_.events;
    const int pupil = std::clamp(samples_for(2 * room), 16, 256);
    beams.views = !on(Effects::aperture) ? 1 : user_.samples > 0 ? user_.samples : pupil;
    const double expected = k_beam_error / std::sqrt(std::max(pixels_.in_picture, 1.0));
    const int check_rays = samples_for(k_check_noise * room);
    const double check_pixel = bands_of_ray * check_rays * price_ns(work_);
    const double drawing = price_ns(beams);
    const double checked = std::clamp(k_check_price * drawing / std::max(check_pixel, 1.0),
                                      double{k_least_checked}, double{k_most_checked});
    const double by_beams = drawing + checked * check_pixel;
    Scene tried = with_effects(on(Effects::dispersion));
    tried.settings.wavelengths_nm = reference.wavelengths_nm;
    const Plan plan = make_plan(tried);
    const std::string refused = refused_by_beams(scene_, plan);

    settings.engine = "reference";
    if (user_.engine != "auto") {
        settings.engine = user_.engine;
        plan_.engine_why = "as the scene says";
    } else if (!refused.empty()) {
        plan_.engine_why = refused;
    } else if (plan.splits) {
        plan_.engine_why = "the two waves of a crystal go their own ways";
    } else if (expected > room) {
        plan_.engine_why = "beams would be off by more than the tolerance in so small a picture";
    } else if (by_beams <= by_paths) {
        settings.engine = "beams";
        plan_.engine_why =
            fmt::format("the reference would take about {:.2g} times as long at {} rays a pixel",
                        by_paths / by_beams, reference.samples);
    } else {
        plan_.engine_why =
            fmt::format("{} rays a pixel do: beams would take about {:.2g} times as long",
                        reference.samples, by_beams / by_paths);
    }
    plan_.bound_of_sampling = noise_.at(reference.samples);
    if (settings.engine == "reference") {
        settings = reference;
        noise_.delta_e *= noise_.at(reference.samples) / std::max(noise_.radiance, 1e-300);
        plan_.seconds = by_paths;
    } else {
        if (dispersed_ && open) choose_beam_wavelengths();
        if (on(Effects::aperture) && user_.samples == 0) settings.samples = pupil;
        settings.checked_samples = check_rays;
        settings.checked_pixels = static_cast<int>(checked);
        settings.wavelength_turns = reference.wavelength_turns;
        plan_.seconds = by_beams;
        noise_.delta_e = 0;
    }
    plan_.seconds_everything =
        pixels_.in_picture * whole_bands_ * std::max(reference.samples, 16) * price_ns(whole_);
}

void Planner::estimate_times() {
    // What this machine's nanosecond is worth, by the first pilot.
    PathWork all = work_;
    all.nodes = 3;
    const double rays = static_cast<double>(pixels_.at.size()) * k_pilot_rays;
    const double priced = rays * price_ns(all);
    machine_ = priced > 0 && first_.seconds > 0 ? 1e9 * first_.seconds / priced : 1;
    const double seconds = 1e-9 * machine_;
    plan_.seconds *= seconds;
    plan_.seconds_everything *= seconds;
    for (PlanItem& line : plan_.items) {
        // So far they hold prices of the pilot with and without.
        const double with = line.seconds_with, without = line.seconds_without;
        line.seconds_with = line.seconds_without = plan_.seconds;
        if (!(with > 0 && without > 0)) continue;
        if (line.on) {
            line.seconds_without = plan_.seconds * without / with;
        } else {
            line.seconds_with = plan_.seconds * with / without;
        }
    }
}

void Planner::add_resolutions() {
    const RenderSettings& settings = plan_.settings;
    const bool beams = drawn_by_beams(settings), piloted = !pixels_.at.empty();
    const auto add = [&](const char* name, bool is_on, std::string fidelity, std::string why,
                         double bound, double delta_e) {
        PlanItem line;
        line.name = name;
        line.on = is_on;
        line.fidelity = std::move(fidelity);
        line.why = std::move(why);
        line.bound = bound;
        line.bound_delta_e = delta_e;
        line.seconds_with = line.seconds_without = plan_.seconds;
        plan_.items.push_back(std::move(line));
    };
    const double unknown = std::numeric_limits<double>::quiet_NaN();
    for (PlanItem& line : plan_.items) {
        if (!line.on) continue;
        if (line.name == "dispersion") line.fidelity = "each wavelength its own way";
        if (line.name == "birefringence") line.fidelity = "both waves, each its own way";
        if (line.name == "polarization") line.fidelity = "exact at every face";
        if (line.name == "absorption") line.fidelity = "along every segment";
        if (line.name == "pleochroism") line.fidelity = "each wave by its own direction";
        if (line.name == "aperture") line.fidelity = "points of the pupil";
        if (line.name == "coherence") line.fidelity = "until their retardation is too large";
    }
    std::string depth, why;
    if (user_.depth > 0) {
        depth = fmt::format("{} faces", user_.depth);
        why = "as the scene says";
    } else if (branches_) {
        depth = "no limit: small paths are left to chance";
        why = "trees of a crystal's waves have no end";
    } else {
        depth = fmt::format("paths above {:.2g} of the light", cut_);
        why = fmt::format("{:.3g} faces on average", work_.events);
    }
    add("depth", true, depth, why, piloted ? cut_bound_ : unknown, cut_delta_e_);
    const std::size_t count = settings.wavelengths_nm.size();
    add("wavelengths", count > 1,
        count == 0   ? "as the scene calls for"
        : count == 1 ? fmt::format("{:g} nm alone", settings.wavelengths_nm[0])
                     : fmt::format("{} wavelengths", count),
        !user_.wavelengths_nm.empty() ? "as the scene says"
        : dispersed_ && !beams        ? "the rays of a pixel take turns with them"
        : spectrum_                   ? "fewer would change the colours"
        : count == 3                  ? "lights in colours, and nothing else depends on wavelength"
        : count == 1                  ? "nothing depends on wavelength"
                                      : "a guess",
        piloted ? wavelength_bound_ : unknown, wavelength_delta_e_);
    const bool edges = hard_edged(scene_.lights);
    add("samples", !beams,
        beams ? "exact areas"
              : fmt::format("{} ray{} a pixel", settings.samples, settings.samples == 1 ? "" : "s"),
        beams               ? "beams tile the picture"
        : user_.samples > 0 ? "as the scene says"
        : piloted           ? fmt::format("{} would be off by {:.2g}", noise_.rays, noise_.radiance)
                            : "a guess",
        beams ? 0 : plan_.bound_of_sampling, beams ? 0 : noise_.delta_e);
    add("light_edges", edges,
        !edges  ? ""
        : beams ? "averaged over the pixel"
                : "by the rays of the pixel",
        edges ? "lights with sharp edges" : "no light has an edge", 0, 0);
    const bool map = scene_.lights.environment != nullptr;
    add("environment_filter", map && beams, map && beams ? "mean over what a pixel sees" : "",
        !map    ? "there is no environment map"
        : beams ? "a pixel sees many texels"
                : "every ray looks up its own texels",
        0, 0);
    add("objects", false, "", "nothing stands beside the stone", 0, 0);
}

}  // namespace culet
