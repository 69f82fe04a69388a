#include "render/plan/proven_drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "render/beams/beam_picture.h"
#include "render/plan/planner.h"
#include "render/plan/proof_pilot.h"
#include "render/reference.h"
#include "render/work_meter.h"

namespace culet {

namespace {

constexpr int k_most_rays = 1600;  // of the plan
// Drawn so often at most: previews, beams, finer ones, and the reference; a crystal's waves as one.
constexpr int k_most_drawings = 5, k_most_as_one = 2;
// Of the tolerance, what finer beams and more rays aim at. Finer beams take longer by about the
// inverse of what is left of the error.
constexpr double k_aim = 0.7, k_bound_aim = 0.9, k_least_aim = 0.3;
// Beams are drawn anew at so many times the price at most: what a few pixels say may be chance.
constexpr double k_steepest = 4, k_least_steep_ns = 2e7;
constexpr int k_more_grids = 2;
// Of the difference: noise that may be all of it; less of it where finding out costs no more than
// this share of the picture's price.
constexpr double k_suspect = 0.25, k_suspect_cheaply = 0.1, k_share_of_suspicion = 0.25;
// What is off by this share still is no better than what was drawn before.
constexpr double k_no_better = 0.8;
// Of a difference that may be all noise, what the picture is taken to be off by.
constexpr double k_hidden = 0.5;
// Of the picture's price, what it may cost to find out what it is off by most, about so many
// drawings of pixels, which are neither too few to tell nor more than that takes.
constexpr double k_share_of_causes = 0.4;
constexpr int k_drawings_of_causes = 4;
constexpr std::size_t k_least_of_causes = 48, k_most_of_causes = 192;
// Of the truth's noise, what an error must be to be seen in it.
constexpr double k_seen_in_noise = 0.5;
// Of the tolerance, what effects that were left out may be off by before they come back; and of
// what a picture is off by that is not near enough.
constexpr double k_misjudged = 0.7, k_main_cause = 0.7;
// The last drawing is the reference's, which is off by nothing but its few rays, unless it would
// take so many times as long.
constexpr double k_last_by_beams = 4;
// About what proofs took of the pictures' prices.
constexpr double k_usual_proof = 0.7;
// Paths at so many times what is left are not begun.
constexpr double k_surely_over = 1.3;
// The next step of a proof may take this share of the picture's price before it is drawn anew,
// which takes longer. Two waves take far longer than one. After the last there is no other way.
constexpr double k_proof_share = 1.5, k_proof_share_as_one = 15, k_last_proof_share = 6,
                 k_least_proof_ns = 3e7;

// The work is what is given, and the tolerance follows.
bool is_paced(const RenderSettings& settings) {
    return settings.meter != nullptr && settings.meter->limited();
}

void add_proof(const Proof& proof, const ScenePlan& plan, RenderStats& stats) {
    stats.error_bound = proof.bound + plan.bound_of_depth;
    stats.checked_pixels = proof.pixels;
    if (stats.engine != "reference") stats.engine_error = proof.bound;
}

}  // namespace

void add_plan(const ScenePlan& plan, RenderStats& stats) {
    for (EffectDecision& decision : stats.effects) {
        const PlanItem& line = plan.item(name_of(decision.effect));
        decision.why = line.why;
        decision.error_bound = line.bound;
    }
    stats.seconds_setup += plan.seconds_planning;
}

double seconds_of(const RenderStats& stats) {
    return stats.seconds_setup + stats.seconds_build + stats.seconds_shade + stats.seconds_check;
}

// Beams are held against the truth by the prover, not by their own check.
RenderResult ProvenDrawing::draw_with(const RenderSettings& settings) {
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

// What the picture's cut and its wavelengths are off by, and finer ones until these are off by
// little.
void ProvenDrawing::find_causes(BeamProposal& beams, const Prover& prover,
                                const RenderSettings& settings, double price) const {
    const std::size_t pixels = std::min(
        prover.pixels_for(k_share_of_causes * price / k_drawings_of_causes), k_most_of_causes);
    if (pixels < k_least_of_causes) return;
    const double tolerance = scene_.settings.tolerance;
    ProofPilot pilot(prover.scene(), settings, prover.sample(pixels), progress_);
    std::vector<double> weights;
    for (const CutChoice& cut : beams.cuts) weights.push_back(cut.weight);
    for (const double weight : weights) {
        if (weight > settings.cut_weight.value_or(0) || beams.knows_cut(weight)) continue;
        if (weight <= pilot.least_cut()) break;
        const double error = pilot.at_cut(weight);
        beams.know_cut(weight, error);
        if (error <= k_share_of_cut * tolerance) break;
    }
    std::vector<int> counts;
    for (const WavelengthChoice& set : beams.sets) counts.push_back(set.count);
    std::sort(counts.begin(), counts.end());
    for (const int count : counts) {
        if (count == 0 || count < static_cast<int>(settings.wavelengths_nm.size()) ||
            beams.knows_wavelengths(count))
            continue;
        if (count >= pilot.wavelengths()) {
            // The same as the truth's, or finer.
            beams.know_wavelengths(count, 0);
            break;
        }
        const double error = pilot.at_wavelengths(even_wavelengths(count));
        // What is less than the truth's noise is not seen.
        if (error < k_seen_in_noise * pilot.noise()) break;
        beams.know_wavelengths(count, error);
        if (error <= k_share_of_wavelengths * tolerance) break;
    }
}

ProvenDrawing::Next ProvenDrawing::more_rays(const ScenePlan& plan, const Tried& tried,
                                             double room) const {
    const int rays = tried.settings.samples;
    const double off = tried.proof.error() + 2 * tried.proof.spread - plan.bound;
    const int more = std::max(rays_to_reach(room, rays, std::max(off, tried.stats.sampling_error)),
                              rays_to_reach(1, rays, 1.3));
    return {with_rays(tried.settings, more, scene_.settings.wavelengths_nm.empty()),
            tried.price * more / rays,
            fmt::format("{} rays a pixel were off by {:.2g}: drawn with more", rays,
                        tried.proof.bound)};
}

std::optional<ProvenDrawing::Next> ProvenDrawing::finer_beams_than(ScenePlan& plan,
                                                                   const Tried& tried) const {
    const Proof& proof = tried.proof;
    const double tolerance = scene_.settings.tolerance;
    const std::string note =
        fmt::format("beams came to within {:.2g} only: drawn with finer ones", proof.bound);
    if (!plan.beams) return std::nullopt;
    // Where the bound is far above the error it stays so.
    const double room =
        tolerance * std::clamp(k_bound_aim * proof.error() / proof.bound, k_least_aim, k_aim);
    const ProposedBeams finer =
        plan.beams->cheapest(room, std::max(k_steepest * tried.price, k_least_steep_ns));
    if (!(finer.price_ns > 0)) return std::nullopt;
    plan.proposed = finer;
    Next next{tried.settings, finer.price_ns, note};
    finer.apply_to(next.settings);
    return next;
}

std::optional<ProvenDrawing::Next> ProvenDrawing::next(ScenePlan& plan, const Tried& tried, Way way,
                                                       bool last) const {
    const RenderSettings &user = scene_.settings, &settings = tried.settings;
    const Proof& proof = tried.proof;
    const bool rays_are_open = user.samples == 0,
               wavelengths_are_open = user.wavelengths_nm.empty();
    if (way == Way::as_one && proof.error() > user.tolerance) return std::nullopt;
    const double room = k_aim * std::max(user.tolerance - plan.bound, 0.3 * user.tolerance);
    if (!drawn_by_beams(settings)) {
        if (!rays_are_open || settings.samples >= k_most_rays) return std::nullopt;
        return more_rays(plan, tried, room);
    }
    // The proof has seen more of what few rays are off by than the plan.
    const int rays = rays_are_open ? std::max(plan.reference.samples,
                                              rays_to_reach(room, proof.samples, proof.noise))
                                   : plan.reference.samples;
    const double by_paths = plan.reference_ns * rays / plan.reference.samples;
    const bool only_beams = way == Way::as_one || user.engine != "auto";
    const std::optional<Next> finer = finer_beams_than(plan, tried);
    if (finer && (only_beams || finer->price * (last ? k_last_by_beams : 1) < by_paths))
        return finer;
    if (only_beams) return std::nullopt;
    return Next{with_rays(plan.reference, rays, wavelengths_are_open), by_paths,
                fmt::format("beams came to within {:.2g} only: drawn by the reference instead",
                            proof.bound)};
}

ProvenPicture ProvenDrawing::draw(ScenePlan plan, Prover& prover, Way way) {
    SoFar so_far;
    try {
        draw_until_proven(plan, prover, way, so_far);
    } catch (const OverAllowance&) {
        if (!so_far.best) throw;
        so_far.done.misjudged = false;
    }
    ProvenPicture done = so_far.done;
    done.result = std::move(*so_far.best);
    // Where the work is what is given, nobody asks how often it was drawn.
    if (!is_paced(scene_.settings)) {
        for (const std::string& note : so_far.notes) done.result.stats.notes.push_back(note);
    }
    done.result.stats.plan = std::move(plan);
    return done;
}

void ProvenDrawing::draw_until_proven(ScenePlan& plan, Prover& prover, Way way, SoFar& so_far) {
    const int most = way == Way::any ? k_most_drawings : way == Way::as_one ? k_most_as_one : 1;
    const double tolerance = scene_.settings.tolerance;
    RenderSettings settings = plan.settings;
    double price = plan.price_ns, seconds_before = 0, error_before = 0;
    WorkMeter* const meter = scene_.settings.meter.get();
    std::optional<RenderResult>& best = so_far.best;
    ProvenPicture& done = so_far.done;
    int pixels_without = 0;  // at which the truth was drawn without what the plan left out
    double off_without = 0;
    if (learned_ && plan.beams) {
        plan.beams->learn_from(*learned_);
        const ProposedBeams other = plan.beams->cheapest(
            (way == Way::as_one ? k_share_as_one : k_share_of_beams) * tolerance);
        if (other.price_ns > 0) {
            plan.proposed = other;
            plan.proposed.apply_to(settings);
            price = other.price_ns;
        }
    }
    for (int drawing = 1;; ++drawing) {
        if (meter != nullptr) meter->expect_more((1 + k_usual_proof) * price);
        // What paths take is known well; what beams take they find out.
        if (is_paced(scene_.settings) && !drawn_by_beams(settings) &&
            price > k_surely_over * meter->left())
            throw OverAllowance();
        RenderResult result = draw_with(settings);
        RenderStats& stats = result.stats;
        const auto start = std::chrono::steady_clock::now();
        const double share = way == Way::as_one ? k_proof_share_as_one
                             : drawing < most   ? k_proof_share
                                                : k_last_proof_share;
        const double most_ns = std::max(k_least_proof_ns, share * price);
        FrameRenderer* frames = frames_ ? &*frames_ : nullptr;
        Proof proof = prover.prove(result.picture, tolerance, most_ns, frames);
        for (int more = 0; more < k_more_grids; ++more) {
            // No better than the one before: first the truth is suspected, whose rays may be
            // noisier than they look.
            if (proof.bound <= tolerance || !(proof.error() > k_no_better * error_before) ||
                error_before == 0)
                break;
            const bool cheap = prover.more_ns() <= k_share_of_suspicion * price;
            if (proof.noise < (cheap ? k_suspect_cheaply : k_suspect) * proof.difference) break;
            prover.take_more();
            proof = prover.prove(result.picture, tolerance, most_ns, frames);
        }
        done.proven = proof.bound <= tolerance;
        // Noise that is all that is seen hides what the picture is off by.
        const double seen = std::max(proof.error(), k_hidden * proof.difference);
        // What was left out is known once its own rays have shown it at the pixels of the proof.
        if (!done.proven && way == Way::any) {
            if (proof.pixels > pixels_without) {
                pixels_without = proof.pixels;
                ProofPilot pilot(prover.scene(), settings,
                                 prover.sample(static_cast<std::size_t>(proof.pixels)), progress_);
                off_without = pilot.without_effects();
                if (plan.beams) plan.beams->effects = off_without;
            }
            done.misjudged = off_without > std::min(k_misjudged * tolerance, k_main_cause * seen);
        }
        if (plan.beams && drawn_by_beams(settings) && !done.proven) {
            find_causes(*plan.beams, prover, settings, price);
            plan.beams->learn(plan.proposed, seen);
            learned_ = plan.beams;
        }
        std::optional<Next> other;
        const double error = proof.error();
        error_before = error;
        if (!done.proven && !done.misjudged && drawing < most)
            other = next(plan, {settings, price, stats, proof}, way, drawing + 1 == most);
        add_plan(plan, stats);
        add_proof(proof, plan, stats);
        stats.seconds_check =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        stats.seconds_setup += seconds_before;
        seconds_before = seconds_of(stats) - plan.seconds_planning;
        if (!best || stats.error_bound < best->stats.error_bound) {
            best = std::move(result);
            plan.settings = settings;
            plan.bound_delta_e = proof.bound_delta_e;
        }
        if (!other) break;
        settings = other->settings;
        price = other->price;
        so_far.notes.push_back(other->note);
    }
}

}  // namespace culet
