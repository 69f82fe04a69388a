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
// Drawn so often at most: beams, finer ones, and the reference; a crystal's waves as one.
constexpr int k_most_drawings = 4, k_most_as_one = 2;
// Of the tolerance, what finer beams and more rays aim at. Finer beams take longer by about the
// inverse of what is left of the error.
constexpr double k_aim = 0.7;
// The last drawing is the reference's, which is off by nothing but its few rays, unless it would
// take so many times as long.
constexpr double k_last_by_beams = 4;
// A proof may take this share of the picture's price before it is drawn anew, which takes longer.
// Two waves take far longer than one.
constexpr double k_proof_share = 1, k_proof_share_as_one = 15, k_least_proof_ns = 6e7;

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

// What is open in a scene, and how its pictures are drawn and proven.
struct Work {
    const Scene& scene;
    Drawer drawer;
    double tolerance = scene.settings.tolerance;
    bool engine_is_open = scene.settings.engine == "auto",
         rays_are_open = scene.settings.samples == 0,
         wavelengths_are_open = scene.settings.wavelengths_nm.empty();
};

struct ProvenPicture {
    RenderResult result;
    bool proven = false;
};

// How a picture is drawn that was not near enough; none: there is no other way.
struct NextDrawing {
    RenderSettings settings;
    double price = 0;
    std::string note;
};
enum class Way { any, as_one };
std::optional<NextDrawing> next_drawing(const Work& work, ScenePlan& plan,
                                        const RenderSettings& settings, double price,
                                        const RenderStats& stats, const Proof& proof, Way way,
                                        bool last) {
    // No finer drawing brings the second wave back.
    if (way == Way::as_one && proof.error() > work.tolerance) return std::nullopt;
    const double off = proof.error() + 2 * proof.spread;
    const double room = k_aim * std::max(work.tolerance - plan.bound, 0.3 * work.tolerance);
    if (!drawn_by_beams(settings)) {
        const int rays = settings.samples;
        if (!work.rays_are_open || rays >= k_most_rays) return std::nullopt;
        const int more =
            std::max(rays_to_reach(room, rays, std::max(off - plan.bound, stats.sampling_error)),
                     rays_to_reach(1, rays, 1.3));
        return NextDrawing{
            with_rays(settings, more, work.wavelengths_are_open), price * more / rays,
            fmt::format("{} rays a pixel were off by {:.2g}: drawn with more", rays, proof.bound)};
    }
    // The proof has seen more of what few rays are off by than the plan.
    const int rays = work.rays_are_open ? std::max(plan.reference.samples,
                                                   rays_to_reach(room, proof.samples, proof.noise))
                                        : plan.reference.samples;
    const double by_paths = plan.reference_ns * rays / plan.reference.samples;
    const FinerBeams finer =
        finer_beams(settings, {proof.error(), stats.remainder, 0.5 * plan.bound_of_wavelengths},
                    k_aim * work.tolerance / off, work.wavelengths_are_open);
    const bool only_beams = way == Way::as_one || !work.engine_is_open;
    if (settings.engine == "beams" &&
        (only_beams || price * finer.price * (last ? k_last_by_beams : 1) < by_paths)) {
        // Half as many wavelengths are off by twice as much, or more.
        const double count = static_cast<double>(settings.wavelengths_nm.size()),
                     more = static_cast<double>(finer.settings.wavelengths_nm.size());
        if (more > 0) plan.bound_of_wavelengths *= count / more;
        return NextDrawing{
            finer.settings, price * finer.price,
            fmt::format("beams came to within {:.2g} only: drawn with finer ones", proof.bound)};
    }
    if (only_beams) return std::nullopt;
    return NextDrawing{
        with_rays(plan.reference, rays, work.wavelengths_are_open), by_paths,
        fmt::format("beams came to within {:.2g} only: drawn by the reference instead",
                    proof.bound)};
}

// Draws as planned, and anew where the picture shows more error than the pilot did: by finer beams,
// then by the reference, and with more rays.
ProvenPicture draw_and_prove(Work& work, ScenePlan plan, Prover& prover, Way way) {
    const int most = way == Way::any ? k_most_drawings : k_most_as_one;
    RenderSettings settings = plan.settings;
    double price = plan.price_ns, seconds_before = 0;
    std::optional<RenderResult> best;
    std::vector<std::string> notes;
    ProvenPicture done;
    for (int drawing = 1;; ++drawing) {
        RenderResult next = work.drawer.draw(settings);
        RenderStats& stats = next.stats;
        const auto start = std::chrono::steady_clock::now();
        const double share = way == Way::any ? k_proof_share : k_proof_share_as_one;
        const Proof proof =
            prover.prove(next.picture, work.tolerance, std::max(k_least_proof_ns, share * price));
        done.proven = proof.bound <= work.tolerance;
        std::optional<NextDrawing> other;
        if (!done.proven && drawing < most)
            other =
                next_drawing(work, plan, settings, price, stats, proof, way, drawing + 1 == most);
        add_plan(plan, stats);
        add_proof(proof, plan, stats);
        stats.seconds_check =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        stats.seconds_setup += seconds_before;
        seconds_before = seconds_of(stats) - plan.seconds_planning;
        if (!best || stats.error_bound < best->stats.error_bound) {
            best = std::move(next);
            plan.settings = settings;
            plan.bound_delta_e = proof.bound_delta_e;
        }
        if (!other) break;
        settings = other->settings;
        price = other->price;
        notes.push_back(other->note);
    }
    done.result = std::move(*best);
    for (const std::string& note : notes) done.result.stats.notes.push_back(note);
    done.result.stats.plan = std::move(plan);
    return done;
}

// Crystals whose two waves may go as one: what that is off by, a pilot of few rays shows as far too
// much, because it shifts light within the pixel.
bool may_go_as_one(const Scene& scene) {
    const Plan plan = make_plan(scene);
    return scene.settings.effects_auto && scene.settings.engine == "auto" && plan.splits &&
           !plan.stokes && scene.stone.convex;
}

}  // namespace

RenderResult render(const Scene& scene, const Progress& progress) {
    if (!leaves_something_open(scene.settings)) return drawn(scene, progress);
    require_renderable(scene);
    Work work{scene, Drawer(scene, progress)};
    std::optional<Prover> prover;
    double seconds_before = 0;
    if (may_go_as_one(scene)) {
        Planner planner(scene, progress, true);
        const ScenePlan plan = planner.run();
        prover = planner.take_prover();
        if (prover && plan.pilot_pixels > 0) {
            ProvenPicture one = draw_and_prove(work, plan, *prover, Way::as_one);
            if (one.proven) {
                for (PlanItem& line : one.result.stats.plan->items) {
                    const bool alone = line.name != name_of(Effects::coherence);
                    if (line.why == k_as_one && alone) line.bound = one.result.stats.error_bound;
                }
                return std::move(one.result);
            }
            seconds_before = seconds_of(one.result.stats);
        }
    }
    Planner planner(scene, progress);
    planner.give_prover(std::move(prover));
    const ScenePlan plan = planner.run();
    prover = planner.take_prover();
    RenderResult result;
    if (!prover || plan.pilot_pixels == 0) {
        Scene settled = scene;
        settled.settings = plan.settings;
        result = drawn(settled, progress);
        add_plan(plan, result.stats);
        result.stats.plan = plan;
    } else {
        result = draw_and_prove(work, plan, *prover, Way::any).result;
    }
    result.stats.seconds_setup += seconds_before;
    return result;
}

}  // namespace culet
