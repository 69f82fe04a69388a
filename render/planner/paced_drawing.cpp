#include "render/planner/paced_drawing.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "render/planner/quick_picture.h"
#include "render/work/work_meter.h"

namespace culet {

namespace {

constexpr double k_coarsest = 0.2;
// At the next tolerance a picture is another one: two waves instead of one, lights looked for.
// What that takes cannot be told from far away, so that steps are small, and what they waste is
// less than the last one takes.
constexpr double k_finer = 2;
// Work rises about as so a power of one over the tolerance.
constexpr double k_power = 1.5;
// Of what is left, what the next picture may take by that. It may come to so many times what it was
// guessed to take, or to this share of what is left: then it is given up for a coarser one.
constexpr double k_share_of_rest = 0.8, k_over_guess = 3, k_most_of_rest = 0.5;
// Steps that would gain less are not made.
constexpr double k_least_step = 1.25;

// Between a tolerance that was reached and those that were too fine.
class Pace {
public:
    explicit Pace(double finest) : finest_(finest), next_(std::max(k_coarsest, finest)) {}

    double tolerance() const { return next_; }
    double guess() const { return guess_; }
    void reached(double bound, double took) {
        reached_ = std::min(next_, std::max(bound, finest_));
        took_ = took;
    }
    void too_fine() { too_fine_ = next_; }

    /// False: no finer one is likely to fit into what is left.
    bool goes_on(double left) {
        if (reached_ == 0) return false;  // not even the coarsest
        double least = std::max(reached_ / k_finer, finest_);
        if (least <= too_fine_) least = std::sqrt(reached_ * too_fine_);
        const double affordable =
            reached_ * std::pow(std::max(took_, 1.0) / (k_share_of_rest * left), 1 / k_power);
        if (!(left > 0)) return false;
        next_ = std::max(least, affordable);
        guess_ = took_ * std::pow(reached_ / next_, k_power);
        const bool last = next_ == finest_ && reached_ > finest_;
        return last || reached_ / next_ >= k_least_step;
    }

private:
    double finest_, next_, reached_ = 0, too_fine_ = 0, took_ = 0, guess_ = 0;
};

}  // namespace

RenderResult draw_within_allowance(const Scene& scene, const Progress& progress,
                                   const DrawToTolerance& draw, const PictureSink& better) {
    const double allowed = scene.settings.allowed_ns;
    const auto meter = std::make_shared<WorkMeter>();
    meter->allow(allowed);
    meter->expect(allowed);
    const Progress counted = counted_by(progress, meter);
    Scene attempt = scene;
    attempt.settings.meter = meter;
    attempt.settings.allowed_ns = 0;
    std::optional<RenderResult> best;
    Pace pace(scene.settings.tolerance);
    for (bool more = true; more;) {
        attempt.settings.tolerance = pace.tolerance();
        const double before = static_cast<double>(meter->spent());
        if (best) {
            meter->allow(std::min(allowed, before + std::max(k_over_guess * pace.guess(),
                                                             k_most_of_rest * (allowed - before))));
        }
        bool near_enough = false;
        try {
            RenderResult result = draw(attempt, counted);
            near_enough = result.stats.error_bound <= pace.tolerance();
            if (!best || result.stats.error_bound < best->stats.error_bound) {
                best = std::move(result);
                best->stats.allowed_tolerance = pace.tolerance();
                if (better) better(*best);
            }
        } catch (const OverAllowance&) {
        }
        // What was let go half done came to what chance had it: all that it might take counts.
        if (meter->over()) meter->use_up();
        const double spent = static_cast<double>(meter->spent());
        if (near_enough) {
            pace.reached(best->stats.error_bound, spent - before);
        } else if (best && before == 0) {
            pace.reached(pace.tolerance(), spent - before);
        } else {
            pace.too_fine();
        }
        more = pace.goes_on(allowed - spent);
    }
    if (!best) {
        // Not even a coarse one: as coarse as it gets, and nobody knows how near.
        best = draw_quickly(scene, progress);
        if (better) better(*best);
    }
    return std::move(*best);
}

}  // namespace culet
