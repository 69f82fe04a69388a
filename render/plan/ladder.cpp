#include "render/plan/ladder.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>

#include "render/beams/beam_picture.h"
#include "render/plan/a_priori.h"
#include "render/plan/planner.h"
#include "render/plan/proof_pilot.h"
#include "render/plan/proven_drawing.h"
#include "render/reference.h"
#include "render/scene_checks.h"
#include "render/work_meter.h"

namespace culet {

namespace {

double env(const char* name, double other) {
    const char* v = std::getenv(name);
    return v ? std::atof(v) : other;
}

constexpr int k_stone_pixels = 112;  // some of which tell how noisy the truth is
constexpr int k_most_drawings = 7;
// Of the tolerance, what the next picture aims at.
const double k_aim = env("L_AIM", 0.5);
const double k_apart = env("L_APART", 0.6);
const double k_cut = env("L_CUT", 1);
const double k_colours = env("L_COLOURS", 0.35), k_cuts = env("L_CUTS", 0.2);
constexpr double k_no_better = 0.8;
constexpr double k_misjudged = 0.7;
constexpr int k_most_rays = 1600;
constexpr double k_least_check_ns = 3e7;
const double k_check_share = env("L_CHECK", 1.5), k_last_check_share = 6;

struct Rung {
    RenderSettings settings;
    double price = 0;  // about; 0: nobody knows
};

class Ladder {
public:
    Ladder(const Scene& scene, const Progress& progress)
        : scene_(scene), drawn_(scene), progress_(progress), user_(scene.settings) {
        window_ = scene;
        if (window_.camera.optics.two_windows) window_.camera.width /= 2;
        one_wave_ = tried_as_one_wave(scene);
        settle_effects();
    }
    RenderResult draw();

private:
    void settle_effects();
    Scene with_effects() const;
    bool beams_can() const;
    bool trees_double() const;
    Rung first_beams() const;
    Rung finer_beams(const Rung& rung, const Proof& proof, double seen, bool again);
    Rung by_reference(double room, const Proof* proof) const;
    RenderResult draw_with(const RenderSettings& settings);
    double price_of_drawn(const RenderStats& stats, const RenderSettings& settings) const;

    const Scene& scene_;
    Scene drawn_, window_;
    const Progress& progress_;
    RenderSettings user_;
    bool one_wave_ = false;
    std::array<bool, k_effect_count> effects_{};
    std::optional<FrameRenderer> frames_;
    mutable std::optional<Prover> prover_;
    double pixels_ = 0;
};

void Ladder::settle_effects() {
    const Plan plan = make_plan(window_);
    for (int e = 0; e < k_effect_count; ++e) effects_[e] = plan.on(static_cast<Effects>(e));
    if (!one_wave_) return;
    for (Effects effect : {Effects::birefringence, Effects::pleochroism, Effects::coherence})
        effects_[static_cast<std::size_t>(effect)] = false;
}

Scene Ladder::with_effects() const {
    Scene scene = window_;
    scene.settings.effects_auto = false;
    scene.settings.effects = effects_;
    return scene;
}

bool Ladder::trees_double() const {
    return make_plan(with_effects()).splits || !scene_.stone.convex;
}

bool Ladder::beams_can() const {
    return user_.engine != "reference" &&
           refused_by_beams(scene_, make_plan(with_effects())).empty();
}

Rung Ladder::first_beams() const {
    Rung rung;
    const Scene scene = with_effects();
    const double T = user_.tolerance;
    RenderSettings& settings = rung.settings = scene.settings;
    const Plan plan = make_plan(scene);
    settings.cut_weight = std::min(0.3, k_cut * T);
    settings.split_weight = settings.cut_weight;
    settings.tolerance = 0.1;
    settings.engine = user_.engine == "beams" || plan.splits ? "beams" : "preview";
    if (user_.wavelengths_nm.empty()) {
        settings.wavelengths_nm = plan.wavelengths_nm;
        if (chose_spectrum(scene, plan)) {
            const int least = T >= 0.02 ? 3 : T >= 0.005 ? 5 : T >= 0.0015 ? 8 : 15;
            settings.wavelengths_nm = even_wavelengths(plan.on(Effects::coherence) ? 29 : least);
        }
    }
    if (plan.on(Effects::aperture) && user_.samples == 0)
        settings.samples = std::clamp(static_cast<int>(3 / T), 16, 256);
    if (plan.splits && plan.bands.size() > 0 && settings.crystal_beams != CrystalBeams::merged) {
        settings.cut_weight = std::min(0.03, 0.009 * std::pow(0.4 * T / 0.047, 1 / 0.6));
        settings.tolerance = std::clamp(T, 1e-3, 0.1);
    }
    return rung;
}

Rung Ladder::finer_beams(const Rung& rung, const Proof& proof, double seen, bool again) {
    Rung finer = rung;
    const double T = user_.tolerance;
    RenderSettings& settings = finer.settings;
    const Scene scene = with_effects();
    const Plan plan = make_plan(scene);
    ProofPilot pilot(prover_->scene(), rung.settings,
                     prover_->sample(std::min<std::size_t>(std::size_t(proof.pixels), 192)), progress_);
    double rest = seen * seen;
    double cost = 1;
    const bool verbose = std::getenv("L_VERBOSE") != nullptr;
    if (user_.wavelengths_nm.empty() && chose_spectrum(scene, plan)) {
        const int before = static_cast<int>(settings.wavelengths_nm.size());
        double first = -1;
        const IndexSpans spans = index_spans(scene);
        const double apart = plan.on(Effects::dispersion) ? k_apart * exit_deviation(spans.dispersion, spans.mean) : 0;
        for (int count : {3, 5, 8, 15, 29, 57}) {
            if (count < before) continue;
            const double error = count >= pilot.wavelengths() ? 0 : pilot.at_wavelengths(even_wavelengths(count));
            if (verbose) fmt::print("      {} nm {:.3g}\n", count, error);
            if (first < 0) first = error;
            settings.wavelengths_nm = even_wavelengths(count);
            if (again && count == before) continue;
            const double model = apart * std::pow(3.0 / count, 0.9);
            if (model <= k_colours * T && (error <= k_colours * T || error < 0.5 * pilot.noise() || again)) break;
        }
        rest -= first * first;
        cost *= double(settings.wavelengths_nm.size()) / before;
    }
    if (!trees_double()) {
        const double before = *settings.cut_weight;
        double first = -1;
        for (double cut = before; cut > pilot.least_cut(); cut /= 3) {
            const double error = pilot.at_cut(cut);
            if (verbose) fmt::print("      cut {:.3g} {:.3g}\n", cut, error);
            if (first < 0) first = error;
            settings.cut_weight = settings.split_weight = cut;
            if (error <= k_cuts * T) break;
        }
        rest -= first * first;
        cost *= std::pow(before / *settings.cut_weight, 0.25);
    } else {
        const double factor = std::clamp(std::pow(k_aim * T / seen, 1 / 0.6), 0.1, 0.5);
        settings.cut_weight = *settings.cut_weight * factor;
        cost *= std::pow(1 / factor, 0.85);
    }
    const double borders = std::sqrt(std::max(rest, 0.0));
    if (verbose) fmt::print("      borders {:.3g}\n", borders);
    const bool same = settings.wavelengths_nm == rung.settings.wavelengths_nm && settings.cut_weight == rung.settings.cut_weight;
    if (borders > k_aim * T || same || again) {
        if (settings.engine == "preview" && user_.engine != "preview") {
            settings.engine = "beams";
            cost *= 2.2;
            // A quarter of the preview's.
            const double left = 0.25 * borders;
            if (left > k_aim * T) {
                const double factor = std::clamp(std::pow(k_aim * T / left, 2), 0.03, 1.0);
                settings.tolerance *= factor;
                cost *= std::pow(1 / factor, 0.4);
            }
        } else {
            const double factor = std::clamp(std::pow(k_aim * T / std::max(borders, 1e-9), 2), 0.1, 0.4);
            settings.tolerance *= factor;
            cost *= std::pow(1 / factor, 0.4);
        }
    }
    finer.price = rung.price * cost;
    return finer;
}

Rung Ladder::by_reference(double room, const Proof* proof) const {
    Rung rung;
    const Scene scene = with_effects();
    RenderSettings& settings = rung.settings = scene.settings;
    settings.engine = "reference";
    const Plan plan = make_plan(scene);
    const bool doubles = trees_double();
    const double T = user_.tolerance;
    settings.cut_weight = doubles ? (T >= 0.02 ? 0.04 : 0.01) : 0.1 * T;
    settings.split_weight = doubles && T >= 0.02 ? 0.6 : std::max(0.1, *settings.cut_weight);
    const double noise = proof ? proof->noise : prover_->noise_of_16();
    const int rays = proof ? proof->samples : 16;
    settings.samples = user_.samples > 0 ? user_.samples : rays_to_reach(room, rays, std::max(noise, 1e-6));
    const bool dispersed = (plan.on(Effects::dispersion) || plan.on(Effects::coherence)) && plan.bands.size() > 1;
    double bands = static_cast<double>(plan.bands.size());
    if (user_.wavelengths_nm.empty()) settings.wavelengths_nm = plan.wavelengths_nm;
    if (dispersed) {
        if (user_.wavelengths_nm.empty())
            settings.wavelengths_nm = even_wavelengths(settings.samples <= 4 ? 29 : settings.samples < 36 ? 29 : 57);
        const int count = static_cast<int>(settings.wavelengths_nm.size());
        settings.wavelength_turns = turns_for(settings.samples, count);
        bands = static_cast<double>(count) / settings.wavelength_turns;
    } else if (user_.wavelengths_nm.empty() && chose_spectrum(scene, plan)) {
        settings.wavelengths_nm = even_wavelengths(T >= 0.03 ? 15 : 29);
    }
    rung.price = pixels_ * settings.samples * prover_->pixel_ns() / std::max(1, prover_->samples());
    (void)bands;
    return rung;
}

RenderResult Ladder::draw_with(const RenderSettings& settings) {
    drawn_.settings = settings;
    if (!drawn_by_beams(settings)) return render_with_reference(drawn_, progress_);
    if (frames_) {
        frames_->show(drawn_);
    } else {
        frames_.emplace(drawn_);
        frames_->report_to(progress_);
    }
    frames_->draw(false);
    return frames_->take();
}

double Ladder::price_of_drawn(const RenderStats& stats, const RenderSettings& settings) const {
    DrawnBeams work;
    const bool parted = make_plan(with_effects()).splits;
    (parted ? work.parted : work.grown) = stats.beams;
    work.fragments = stats.rays;
    work.nodes = 1;
    (void)settings;
    return price_ns(work) + 4e6;
}

RenderResult Ladder::draw() {
    const double T = user_.tolerance;
    const StonePixels pixels = stone_pixels(window_, k_stone_pixels);
    pixels_ = pixels.in_picture;
    if (pixels.at.empty()) {
        drawn_.settings = user_;
        if (user_.engine == "auto") drawn_.settings.engine = "reference";
        return draw_with(drawn_.settings);
    }
    prover_.emplace(window_, pixels, T, progress_);
    const bool verbose = std::getenv("L_VERBOSE") != nullptr;
    Rung rung = beams_can() ? first_beams() : by_reference(k_aim * T, nullptr);
    std::optional<RenderResult> best;
    RenderSettings best_settings;
    double error_before = 0;
    std::vector<std::string> notes;
    double off_without = 0;
    int drawings = 0;
    int pixels_without = 0;
    for (int drawing = 1;; ++drawing) {
        const auto clock = std::clock();
        RenderResult result = draw_with(rung.settings);
        const double draw_ms = 1e3 * double(std::clock() - clock) / CLOCKS_PER_SEC;
        const bool beams = drawn_by_beams(rung.settings);
        if (beams) rung.price = price_of_drawn(result.stats, rung.settings);
        else rung.price = std::max(rung.price, 1e6);
        const bool last = drawing == k_most_drawings;
        const double most_ns =
            std::max(k_least_check_ns, (last || !beams ? k_last_check_share : k_check_share) * rung.price);
        FrameRenderer* frames = frames_ ? &*frames_ : nullptr;
        Proof proof = prover_->prove(result.picture, T, most_ns, frames);
        for (int more = 0; more < 2; ++more) {
            if (proof.bound <= T || error_before == 0 || !(proof.error() > k_no_better * error_before)) break;
            if (proof.noise < 0.25 * proof.difference) break;
            prover_->take_more();
            proof = prover_->prove(result.picture, T, most_ns, frames);
        }
        const double all_ms = 1e3 * double(std::clock() - clock) / CLOCKS_PER_SEC;
        if (verbose)
            fmt::print("    {} tol {:.2g} cut {:.2g} nm {} rays {}: error {:.3g} noise {:.2g} bound {:.3g} px {} x {}; draw {:.1f} ({:.1f}) check {:.1f} ms\n",
                       rung.settings.engine, rung.settings.tolerance, *rung.settings.cut_weight,
                       rung.settings.wavelengths_nm.size(), rung.settings.samples, proof.error(), proof.noise, proof.bound, proof.pixels, proof.samples,
                       draw_ms, 1e-6 * rung.price, all_ms - draw_ms);
        RenderStats& stats = result.stats;
        stats.error_bound = proof.bound;
        stats.checked_pixels = proof.pixels;
        const bool near_enough = proof.bound <= T;
        const double seen = std::max(proof.error(), 0.5 * proof.difference);
        if (!best || proof.bound < best->stats.error_bound) {
            best = std::move(result);
            best_settings = rung.settings;
        }
        if (near_enough || last) break;
        if (one_wave_) {
            if (proof.pixels > pixels_without) {
                pixels_without = proof.pixels;
                ProofPilot pilot(prover_->scene(), rung.settings,
                                 prover_->sample(static_cast<std::size_t>(proof.pixels)), progress_);
                off_without = pilot.without_effects();
            }
            if (verbose) fmt::print("    without {:.3g}\n", off_without);
            if (off_without > k_misjudged * std::min(T, seen)) {
                one_wave_ = false;
                settle_effects();
                error_before = 0;
                const Rung reference = by_reference(k_aim * T, &proof);
                drawings = 0;
                rung = beams_can() ? first_beams() : reference;
                continue;
            }
        }
        if (!beams) {
            if (user_.samples > 0 || rung.settings.samples >= k_most_rays) break;
            const int rays = rung.settings.samples;
            const int more = std::max(rays_to_reach(k_aim * T, rays, proof.error() + 2 * proof.spread),
                                      rays_to_reach(1, rays, 1.3));
            const double price = rung.price * more / rays;
            rung.settings = with_rays(rung.settings, more, user_.wavelengths_nm.empty());
            rung.price = price;
            error_before = proof.error();
            continue;
        }
        const Rung finer = finer_beams(rung, proof, seen, drawings++ > 0);
        const double finer_price = finer.price;
        const Rung reference = by_reference(k_aim * T, &proof);
        if (verbose) fmt::print("    next: beams {:.1f}, reference {:.1f} ms ({} rays)\n", 1e-6 * finer_price, 1e-6 * reference.price, reference.settings.samples);
        error_before = proof.error();
        rung = finer_price <= reference.price || user_.engine != "auto" ? finer : reference;
    }
    ScenePlan plan;
    plan.settings = best_settings;
    plan.settings.meter = nullptr;
    plan.tolerance = T;
    best->stats.plan = plan;
    return std::move(*best);
}

}  // namespace

RenderResult drawn_by_ladder(const Scene& scene, const Progress& progress) {
    require_renderable(scene);
    return Ladder(scene, progress).draw();
}

}  // namespace culet
