#include <algorithm>
#include <cmath>

#include "render/beams/beam_picture.h"
#include "render/plan/a_priori.h"
#include "render/plan/planner.h"

namespace culet {

namespace {

// What paths below a weight bring, about: of thirty scenes (bench_plan) 0.1 to 0.9 times the
// weight, one in ten more.
constexpr double k_cut_error = 0.5;
constexpr int k_cuts = 6;
// Leaving dispersion out was off by as much as colours leave apart, or more; this much of the
// tolerance may go for it.
constexpr double k_share_of_small_effects = 0.25;
// A picture that costs no more than so many pilots is drawn without one: two in three are near
// enough, and of the others the proof tells as much.
constexpr double k_pilots = 2;

}  // namespace

// What choices usually cost in accuracy, where light has one way through the stone.
BeamProposal Planner::usual_beams(const Scene& scene) const {
    const Plan plan = make_plan(scene);
    BeamProposal proposal = beams_of(plan, glance_work_);
    double weight = coarsest_cut();
    for (int i = 0; i < k_cuts; ++i, weight /= k_cut_step)
        proposal.cuts.push_back({weight, k_cut_error * weight, 0, 0});
    proposal.dispersed = plan.on(Effects::dispersion) && plan.bands.size() > 1;
    proposal.sets = {WavelengthChoice{}};
    if (user_.wavelengths_nm.empty() && chose_spectrum(scene, plan))
        proposal.sets = usual_wavelengths();
    return proposal;
}

// To `plan_`; false: there is nothing to propose.
bool Planner::proposes_at_a_glance() {
    const Scene whole = with_effects(true);
    // A lens needs its noise known, a depth what it leaves out, and trees that branch their size.
    if (pixels_.at.empty() || branches_ || on(Effects::aperture) || user_.depth > 0 ||
        user_.engine == "reference" || !refused_by_beams(scene_, make_plan(whole)).empty())
        return false;
    const double room = (one_wave_ ? k_share_as_one : k_share_of_beams) * tolerance_;
    BeamProposal proposal = usual_beams(whole);
    ProposedBeams best = proposal.cheapest(room);
    const IndexSpans spans = index_spans(scene_);
    const double without = exit_deviation(spans.dispersion, spans.mean);
    PlanItem& dispersion = item(Effects::dispersion);
    if (proposal.dispersed && user_.effects_auto && leave_ == Leave::likely &&
        without <= k_share_of_small_effects * tolerance_) {
        dispersion.on = false;
        BeamProposal flat = usual_beams(with_effects(false));
        flat.effects = without;
        const ProposedBeams other = flat.cheapest(room);
        if (other.error <= room && other.price_ns < best.price_ns) {
            best = other;
            proposal = std::move(flat);
            dispersion.why = k_by_its_size;
        } else {
            dispersion.on = true;
        }
    }
    if (best.error > room || best.price_ns > k_pilots * pilot_ns_) return false;
    plan_.proposed = best;
    plan_.beams = std::move(proposal);
    return true;
}

std::optional<ScenePlan> Planner::at_a_glance() {
    look();
    Planner quick(*this);
    if (!quick.proposes_at_a_glance()) return std::nullopt;
    return quick.plan_of_glance();
}

ScenePlan Planner::plan_of_glance() {
    at_a_glance_ = true;
    dispersed_ = plan_.beams->dispersed;
    spectrum_ = plan_.proposed.wavelengths.count > 0;
    work_ = glance_work_;
    RenderSettings& settings = plan_.settings;
    plan_.proposed.apply_to(settings);
    if (!spectrum_ && user_.wavelengths_nm.empty())
        settings.wavelengths_nm = make_plan(with_effects(on(Effects::dispersion))).wavelengths_nm;
    cut_ = plan_.proposed.cut.weight;
    plan_.engine_why = "likely near enough at a glance, and drawn sooner than looked into";
    plan_.price_ns = plan_.proposed.price_ns;
    plan_.seconds = plan_.seconds_everything = 1e-9 * plan_.price_ns;
    plan_.pilot_pixels = static_cast<int>(pixels_.at.size());
    plan_.mean_radiance = glance_.mean;
    plan_.bound = plan_.bound_delta_e = plan_.bound_of_sampling = k_unknown;
    for (PlanItem& line : plan_.items) {
        line.seconds_with = line.seconds_without = plan_.seconds;
        if (line.on) line.matters = line.matters_delta_e = k_unknown;
    }
    finish();
    plan_.reference = settings;
    plan_.seconds_planning = seconds_looking_;
    return plan_;
}

}  // namespace culet
