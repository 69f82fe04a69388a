#include "render/planner/cause_pilot.h"

#include <algorithm>
#include <cmath>

#include "render/colour/colour_error.h"
#include "render/planner/wavelengths.h"

namespace culet {

CausePilot::CausePilot(const Scene& scene, const RenderSettings& drawn, CheckedSample sample,
                       const Progress& progress)
    : scene_(scene), without_(scene), sample_(std::move(sample)), progress_(progress) {
    without_.settings.effects_auto = false;
    without_.settings.effects = drawn.effects;
}

std::vector<Rgb> CausePilot::draw(const Scene& scene, const PathLimits& limits) const {
    return draw_pilot(scene, sample_.pixels, limits, sample_.rays, sample_.nodes, progress_).rgb;
}

double CausePilot::between(const std::vector<Rgb>& some, const std::vector<Rgb>& others) const {
    double errors = 0, sizes = 0;
    for (std::size_t i = 0; i < sample_.truth.size(); ++i) {
        errors += sample_.counts[i] * apart(some[i], others[i]);
        sizes += sample_.counts[i] * mean_of(sample_.truth[i]);
    }
    return sizes > 0 ? errors / sizes : 0;
}

// Fewer effects and wavelengths have other noise.
double CausePilot::beyond_noise(double difference) const {
    return std::sqrt(std::max(0.0, difference * difference - sample_.noise * sample_.noise));
}

const std::vector<Rgb>& CausePilot::with_drawn_effects() {
    if (seen_) return *seen_;
    const OpticalSetup of_truth = make_optical_setup(scene_, sample_.nodes),
                       left = make_optical_setup(without_, sample_.nodes);
    bool leaves_out = false;
    for (int e = 0; e < k_effect_count; ++e) {
        leaves_out |= of_truth.on(static_cast<Effects>(e)) && !left.on(static_cast<Effects>(e));
    }
    without_.settings.wavelength_turns = turns_for(sample_.rays, sample_.nodes);
    seen_ = leaves_out ? draw(without_, sample_.limits) : sample_.truth;
    return *seen_;
}

double CausePilot::without_effects() {
    return beyond_noise(between(with_drawn_effects(), sample_.truth));
}

double CausePilot::at_cut(double weight) {
    const std::vector<Rgb>& whole = with_drawn_effects();
    PathLimits limits = sample_.limits;
    limits.cut_weight = std::max(limits.cut_weight, weight);
    return between(draw(without_, limits), whole);
}

double CausePilot::at_wavelengths(const std::vector<double>& nm) {
    const std::vector<Rgb>& whole = with_drawn_effects();
    Scene few = without_;
    few.settings.wavelengths_nm = nm;
    few.settings.wavelength_turns = turns_for(sample_.rays, static_cast<int>(nm.size()));
    return beyond_noise(between(draw(few, sample_.limits), whole));
}

}  // namespace culet
