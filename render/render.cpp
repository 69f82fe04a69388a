#include "render/render.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "render/beams/beam_picture.h"
#include "render/plan/planner.h"
#include "render/reference.h"
#include "render/scene_checks.h"

namespace culet {

namespace {

constexpr int k_most_rays = 1600;  // of the plan
// Drawn so often at most: beams, finer ones, and the reference.
constexpr int k_most_drawings = 4;
// Of the tolerance, what finer beams and more rays aim at. Finer beams take longer by about the
// inverse of what is left of the error.
constexpr double k_aim = 0.7;
// A proof may take this share of the picture's price before it is drawn anew, which takes longer.
constexpr double k_proof_share = 1, k_least_proof_ns = 2e7;

bool leaves_something_open(const RenderSettings& settings) {
    return settings.tolerance > 0 &&
           (settings.engine == "auto" || settings.effects_auto || settings.wavelengths_nm.empty());
}

RenderResult drawn(const Scene& scene, const Progress& progress) {
    return drawn_by_beams(scene.settings) ? render_with_beams(scene, progress)
                                          : render_with_reference(scene, progress);
}

// Draws again and again with other settings, without the beams' own check.
class Drawer {
public:
    Drawer(const Scene& scene, const Progress& progress) : scene_(scene), progress_(progress) {}

    RenderResult draw(const RenderSettings& settings) {
        scene_.settings = settings;
        if (!drawn_by_beams(settings)) return render_with_reference(scene_, progress_);
        if (frames_) {
            frames_->draw_with(settings);
        } else {
            frames_.emplace(scene_);
            frames_->report_to(progress_);
        }
        return frames_->draw(false);
    }

private:
    Scene scene_;
    const Progress& progress_;
    std::optional<FrameRenderer> frames_;
};

void add_plan(const ScenePlan& plan, RenderStats& stats) {
    for (EffectDecision& decision : stats.effects) {
        const PlanItem& line = plan.item(name_of(decision.effect));
        decision.why = line.why;
        decision.error_bound = line.bound;
    }
    stats.seconds_setup += plan.seconds_planning;
}

void add_proof(const Proof& proof, const ScenePlan& plan, RenderStats& stats) {
    stats.error_bound = proof.bound + plan.bound_of_depth;
    stats.checked_pixels = proof.pixels;
    if (stats.engine != "reference") stats.engine_error = proof.bound;
    std::erase_if(stats.notes, [](const std::string& note) {
        return note.find("over the tolerance") != std::string::npos;
    });
    if (stats.error_bound > plan.tolerance) {
        stats.notes.push_back(fmt::format("the error bound {:.3g} is over the tolerance {:.3g}",
                                          stats.error_bound, plan.tolerance));
    }
}

double seconds_of(const RenderStats& stats) {
    return stats.seconds_setup + stats.seconds_build + stats.seconds_shade + stats.seconds_check;
}

}  // namespace

RenderResult render(const Scene& scene, const Progress& progress) {
    if (!leaves_something_open(scene.settings)) return drawn(scene, progress);
    require_renderable(scene);
    Planner planner(scene, progress);
    ScenePlan plan = planner.run();
    Prover* prover = planner.prover();
    if (prover == nullptr || plan.pilot_pixels == 0) {
        Scene settled = scene;
        settled.settings = plan.settings;
        RenderResult result = drawn(settled, progress);
        add_plan(plan, result.stats);
        result.stats.plan = plan;
        return result;
    }
    // Where the picture shows more error than the pilot did: finer beams, then the reference, and
    // more rays.
    const double tolerance = scene.settings.tolerance;
    const bool engine_is_open = scene.settings.engine == "auto",
               rays_are_open = scene.settings.samples == 0,
               wavelengths_are_open = scene.settings.wavelengths_nm.empty();
    double price = plan.price_ns;
    Drawer drawer(scene, progress);
    RenderSettings settings = plan.settings;
    std::optional<RenderResult> best;
    std::vector<std::string> notes;
    double seconds_before = 0;
    for (int drawing = 1;; ++drawing) {
        RenderResult next = drawer.draw(settings);
        RenderStats& stats = next.stats;
        const auto start = std::chrono::steady_clock::now();
        const double most_ns = std::max(k_least_proof_ns, k_proof_share * price);
        Proof proof = prover->prove(next.picture, tolerance, most_ns);
        // Near enough, but for what the truth's few rays are off by.
        const auto nearly = [&] {
            return proof.bound > tolerance && proof.error() + 2 * proof.spread <= tolerance;
        };
        for (int finer = 0; finer < 2 && nearly(); ++finer) {
            prover->take_more();
            proof = prover->prove(next.picture, tolerance, most_ns);
        }
        add_plan(plan, stats);
        add_proof(proof, plan, stats);
        stats.seconds_check =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        stats.seconds_setup += seconds_before;
        seconds_before = seconds_of(stats) - plan.seconds_planning;
        const double sampling_error = stats.sampling_error, cut = stats.remainder;
        if (!best || stats.error_bound < best->stats.error_bound) {
            best = std::move(next);
            plan.settings = settings;
            plan.bound_delta_e = proof.bound_delta_e;
        }
        if (proof.bound <= tolerance || drawing == k_most_drawings) break;
        const double off = proof.error() + 2 * proof.spread;
        const double room = k_aim * std::max(tolerance - plan.bound, 0.3 * tolerance);
        if (drawn_by_beams(settings)) {
            // The proof has seen more of what few rays are off by than the plan.
            const int rays = rays_are_open
                                 ? std::max(plan.reference.samples,
                                            rays_to_reach(room, proof.samples, proof.noise))
                                 : plan.reference.samples;
            const double by_paths = plan.reference_ns * rays / plan.reference.samples;
            const FinerBeams finer =
                finer_beams(settings, {proof.error(), cut, 0.5 * plan.bound_of_wavelengths},
                            k_aim * tolerance / off, wavelengths_are_open);
            if (settings.engine == "beams" && drawing + 1 < k_most_drawings &&
                (!engine_is_open || price * finer.price < by_paths)) {
                notes.push_back(fmt::format(
                    "beams came to within {:.2g} only: drawn with finer ones", proof.bound));
                plan.bound_of_wavelengths *= static_cast<double>(settings.wavelengths_nm.size()) /
                                             static_cast<double>(std::max<std::size_t>(
                                                 finer.settings.wavelengths_nm.size(), 1));
                settings = finer.settings;
                price *= finer.price;
                continue;
            }
            if (!engine_is_open) break;
            notes.push_back(fmt::format(
                "beams came to within {:.2g} only: drawn by the reference instead", proof.bound));
            settings = with_rays(plan.reference, rays, wavelengths_are_open);
            price = by_paths;
        } else {
            const int rays = settings.samples;
            if (!rays_are_open || rays >= k_most_rays) break;
            const int more =
                std::max(rays_to_reach(room, rays, std::max(off - plan.bound, sampling_error)),
                         rays_to_reach(1, rays, 1.3));
            settings = with_rays(settings, more, wavelengths_are_open);
            notes.push_back(fmt::format("{} rays a pixel were off by {:.2g}: drawn with more", rays,
                                        proof.bound));
            price *= static_cast<double>(more) / rays;
        }
    }
    for (const std::string& note : notes) best->stats.notes.push_back(note);
    best->stats.plan = plan;
    return std::move(*best);
}

}  // namespace culet
