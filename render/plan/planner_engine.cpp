#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "render/beams/beam_picture.h"
#include "render/colour_error.h"
#include "render/plan/planner.h"

namespace culet {

namespace {

constexpr int k_most_side = 40;  // of the grid of rays in a pixel
// Of what is left of the tolerance, what the noise of few rays may be.
constexpr double k_share_of_noise = 0.8;
// Beams that are so many times as cheap as 16 rays are taken without a look at the reference.
constexpr double k_far_cheaper = 2;
// What the truth's few rays may be off by, as a share of what pictures may: enough for the proof to
// succeed, and few rays.
constexpr double k_share_of_truth = 0.7;
// Lights so much brighter than the picture are met by few rays. Of 16 rays the noise was 0.04 of
// the light's root mean square in a diamond under a light box.
constexpr double k_rare_light = 50, k_rare_noise = 0.04, k_most_noise = 0.5;
// CIEDE2000 of noise of the mean radiance: about, in pictures of many colours.
constexpr double k_delta_e_of_noise = 40;
// Crystals' beams are cut, and not gambled on: at 0.009 that left 0.047 of the light, and others in
// proportion to the cut to the power of 0.6.
constexpr double k_crystal_cut = 0.009, k_crystal_remainder = 0.047, k_crystal_power = 0.6,
                 k_crystal_step = 2;
constexpr int k_crystal_cuts = 12;

// With which the rays of a pixel take turns.
int nodes_for(int rays) {
    return rays <= 4 ? 15 : rays < 36 ? 29 : 57;
}

bool hard_edged(const Lights& lights) {
    return std::any_of(lights.sources.begin(), lights.sources.end(), has_edge);
}

}  // namespace

int rays_to_reach(double room, int rays, double off) {
    constexpr double k_power = 0.7;
    const double wanted = rays * std::pow(off / room, 1 / k_power);
    int side = std::min(static_cast<int>(std::ceil(std::sqrt(std::min(wanted, 1e6)))), k_most_side);
    while (Prover::takes_grid(side)) ++side;
    return side * side;
}

double Planner::Noise::at(double count) const {
    return radiance * std::pow(rays / count, power);
}

int Planner::samples_for(double room) const {
    for (int side = 1; side < k_most_side; ++side) {
        if (noise_.at(side * side) <= room && !Prover::takes_grid(side)) return side * side;
    }
    return k_most_side * k_most_side;
}

RenderSettings with_rays(const RenderSettings& settings, int rays, bool wavelengths_are_open) {
    RenderSettings more = settings;
    more.samples = rays;
    // Where the rays take turns with the wavelengths, more rays carry more of these.
    if (settings.wavelength_turns <= 1) return more;
    const int before = static_cast<int>(settings.wavelengths_nm.size());
    const int nodes = wavelengths_are_open ? std::max(before, nodes_for(rays)) : before;
    if (nodes != before) more.wavelengths_nm = even_wavelengths(nodes);
    more.wavelength_turns = turns_for(rays, nodes);
    return more;
}

double Planner::choose_reference(double room) {
    RenderSettings& reference = plan_.reference;
    reference = plan_.settings;
    reference.engine = "reference";
    reference.samples = user_.samples > 0 ? user_.samples : samples_for(k_share_of_noise * room);
    double bands_of_ray = 1;
    if (dispersed_) {
        if (user_.wavelengths_nm.empty()) {
            const int least = on(Effects::coherence) ? 29 : 15;
            reference.wavelengths_nm =
                even_wavelengths(std::max(nodes_for(reference.samples), least));
        }
        const int bands = static_cast<int>(reference.wavelengths_nm.size());
        reference.wavelength_turns = turns_for(reference.samples, bands);
        bands_of_ray = static_cast<double>(bands) / reference.wavelength_turns;
        work_.nodes = 1;
    } else {
        Scene drawn = with_effects(false);
        drawn.settings.wavelengths_nm = reference.wavelengths_nm;
        const Plan plan = make_plan(drawn);
        bands_of_ray = static_cast<double>(plan.bands.size());
        work_.nodes = plan.bands.front().count;
    }
    return pixels_.in_picture * reference.samples * bands_of_ray * price_ns(work_);
}

// Points of the pupil that beams take; 1 without one.
int Planner::choose_pupil(double room) {
    RenderSettings& settings = plan_.settings;
    if (!on(Effects::aperture)) return 1;
    if (user_.samples == 0) settings.samples = std::clamp(samples_for(2 * room), 16, 256);
    return settings.samples;
}

// Without choices.
BeamProposal Planner::beams_of(const Plan& plan, const PathWork& work) const {
    BeamProposal proposal;
    proposal.pixels = pixels_.in_picture;
    proposal.events_per_ray = work.events;
    proposal.bands = static_cast<int>(plan.bands.size());
    proposal.polarised = work.polarised;
    proposal.previews = user_.engine != "beams" && !branches_;
    proposal.borders_are_open = user_.engine != "preview";
    return proposal;
}

// It costs beams little. What leaving it out is off by is everywhere, and adds up with what borders
// are off by as it is; where the rest would have to be so much finer for it that the picture would
// be dearer, it stays.
void Planner::bring_polarization_back(BeamProposal& proposal, double room) {
    PlanItem& line = item(Effects::polarization);
    if (line.on || !user_.effects_auto || !(line.matters > 0) || branches_) return;
    const double off_by = std::min(line.bound, line.matters);
    BeamProposal with = proposal, without = proposal;
    with.polarised = true;
    with.effects = without.effects =
        std::sqrt(std::max(0.0, left_out_ * left_out_ - off_by * off_by));
    const ProposedBeams dearer = with.cheapest(room), cheaper = without.cheapest(room - off_by);
    // What previews are off by is known within a factor of three only: no reason to bring it back.
    if (dearer.preview || dearer.error > room || cheaper.price_ns == 0 ||
        !(dearer.price_ns < cheaper.price_ns))
        return;
    line.on = true;
    if (!refused_by_beams(scene_, make_plan(with_effects(on(Effects::dispersion)))).empty()) {
        line.on = false;
        return;
    }
    line.why = fmt::format(
        "bound {:.2g} under tolerance {:g}, but leaving it out would save less than it costs "
        "elsewhere",
        line.bound, tolerance_);
    spent_ -= line.bound;
    left_out_ = with.effects;
    line.bound = line.bound_delta_e = 0;
    work_.polarised = true;
    proposal = std::move(with);
}

double Planner::choose_beams() {
    Scene tried = with_effects(on(Effects::dispersion));
    tried.settings.wavelengths_nm = plan_.settings.wavelengths_nm;
    BeamProposal proposal = beams_of(make_plan(tried), work_);
    proposal.cuts = cuts_;
    if (branches_) {
        double weight = 3 * k_crystal_cut;
        for (int i = 0; i < k_crystal_cuts; ++i, weight /= k_crystal_step) {
            const double off =
                k_crystal_remainder * std::pow(weight / k_crystal_cut, k_crystal_power);
            proposal.cuts.push_back({weight, off, off, 0});
        }
        proposal.parted = plan_.settings.crystal_beams != CrystalBeams::merged;
    }
    proposal.sets = sets_;
    proposal.effects = left_out_;
    proposal.views = choose_pupil(tolerance_);
    proposal.dispersed = dispersed_;
    const double room = (one_wave_ ? k_share_as_one : k_share_of_beams) * tolerance_;
    bring_polarization_back(proposal, room);
    plan_.proposed = proposal.cheapest(room);
    plan_.beams = std::move(proposal);
    return plan_.proposed.price_ns;
}

// What the reference's rays are off by, as the truth's first pixels show it.
void Planner::measure_noise() {
    noise_.radiance = prover_->noise_of_16();
    noise_.power = dispersed_ ? 0.6 : 0.7;
    // A small bright light that no ray of the pilot met brings as much as all the rest, as far as
    // is known: the light's root mean square is that of the brightest over the mean at most.
    const double rare = first_.mean > 0 ? first_.brightest / first_.mean : 1;
    if (rare > k_rare_light)
        noise_.radiance =
            std::max(noise_.radiance, std::min(k_rare_noise * std::sqrt(rare), k_most_noise));
    noise_.delta_e = k_delta_e_of_noise * noise_.radiance;
}

void Planner::choose_engine_and_samples() {
    RenderSettings& settings = plan_.settings;
    settings.cut_weight = limits_of_picture().cut_weight;
    settings.split_weight = limits_of_picture().split_weight;
    plan_.mean_radiance = first_.mean;
    plan_.pilot_pixels = static_cast<int>(pixels_.at.size());
    // Errors of causes of their own add up as their squares do, about: the proof will tell.
    const auto left_of = [&](double other) {
        return std::sqrt(std::max(std::pow(tolerance_, 2) - std::pow(left_out_, 2) - other * other,
                                  std::pow(0.4 * tolerance_, 2)));
    };
    const double room = left_of(branches_ ? 0 : cut_error_);
    Scene tried = with_effects(on(Effects::dispersion));
    tried.settings.wavelengths_nm = settings.wavelengths_nm;
    const std::string refused = refused_by_beams(scene_, make_plan(tried));
    // As if 16 rays did: where beams are far cheaper than that, nobody needs to know.
    noise_ = {16, k_share_of_noise * room, 0, 0.7};
    // Points of a pupil are as many as the noise asks for, whatever draws them.
    if (on(Effects::aperture)) measure_noise();
    double by_paths = choose_reference(room), by_beams = 0;
    const RenderSettings of_neither = settings;
    if (refused.empty()) by_beams = choose_beams();
    const bool noise_matters = branches_ || on(Effects::aperture) || !refused.empty() ||
                               user_.engine == "reference" || k_far_cheaper * by_beams > by_paths;
    if (noise_matters) {
        if (!on(Effects::aperture)) measure_noise();
        const RenderSettings of_beams = settings;
        settings = of_neither;
        by_paths = choose_reference(room);
        settings = of_beams;
    }

    if (user_.engine != "auto") {
        settings.engine = user_.engine;
        plan_.engine_why = "as the scene says";
    } else if (!refused.empty()) {
        settings.engine = "reference";
        plan_.engine_why = refused;
    } else if (by_beams <= by_paths) {
        settings.engine = "beams";
        plan_.engine_why =
            fmt::format("the reference would take about {:.2g} times as long at {} rays a pixel",
                        by_paths / by_beams, plan_.reference.samples);
    } else {
        settings.engine = "reference";
        plan_.engine_why =
            fmt::format("{} rays a pixel do: beams would take about {:.2g} times as long",
                        plan_.reference.samples, by_beams / by_paths);
    }
    plan_.bound_of_sampling = noise_matters ? noise_.at(plan_.reference.samples) : k_unknown;
    if (!drawn_by_beams(settings)) {
        settings = plan_.reference;
        noise_.delta_e *= plan_.bound_of_sampling / std::max(noise_.radiance, 1e-300);
        plan_.seconds = by_paths;
        plan_.beams.reset();
        // The rays take turns with many.
        if (dispersed_) wavelength_bound_ = wavelength_delta_e_ = 0;
    } else {
        plan_.seconds = by_beams;
        noise_.delta_e = 0;
        if (plan_.beams) {
            plan_.proposed.apply_to(settings);
            take(plan_.proposed.cut);
            take(plan_.proposed.wavelengths);
        }
    }
    spent_ += cut_bound_ + wavelength_bound_;
    plan_.price_ns = plan_.seconds;
    plan_.reference_ns = by_paths;
    plan_.seconds_everything = pixels_.in_picture * whole_bands_ *
                               std::max(plan_.reference.samples, 16) * price_ns(whole_);
    if (noise_matters) prover_->take(samples_for(k_share_of_truth * tolerance_));
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
    const bool beams = drawn_by_beams(settings), preview = settings.engine == "preview",
               piloted = !pixels_.at.empty() && !at_a_glance_;
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
    } else if (branches_ && !beams) {
        depth = "no limit: small paths are left to chance";
        why = "trees of a crystal's waves have no end";
    } else {
        depth = fmt::format("paths above {:.2g} of the light", cut_);
        why = fmt::format("{:.3g} faces on average", work_.events);
    }
    add("depth", true, depth, why, piloted ? cut_bound_ : k_unknown, cut_delta_e_);
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
        piloted ? wavelength_bound_ : k_unknown, wavelength_delta_e_);
    const bool edges = hard_edged(scene_.lights);
    add("samples", !beams,
        preview ? "exact areas, one colour a region"
        : beams
            ? "exact areas"
            : fmt::format("{} ray{} a pixel", settings.samples, settings.samples == 1 ? "" : "s"),
        beams               ? "beams tile the picture"
        : user_.samples > 0 ? "as the scene says"
        : piloted           ? fmt::format("{} would be off by {:.2g}", noise_.rays, noise_.radiance)
                            : "a guess",
        beams ? 0 : plan_.bound_of_sampling, beams ? 0 : noise_.delta_e);
    add("light_edges", edges,
        !edges    ? ""
        : preview ? "one colour a region"
        : beams   ? "averaged over the pixel"
                  : "by the rays of the pixel",
        edges ? "lights with sharp edges" : "no light has an edge", 0, 0);
    const bool map = scene_.lights.environment != nullptr;
    const bool filtered = map && beams && !preview;
    add("environment_filter", filtered, filtered ? "mean over what a pixel sees" : "",
        !map      ? "there is no environment map"
        : preview ? "one colour a region"
        : beams   ? "a pixel sees many texels"
                  : "every ray looks up its own texels",
        0, 0);
    add("objects", false, "", "nothing stands beside the stone", 0, 0);
}

}  // namespace culet
