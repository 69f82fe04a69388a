#include "render/plan/paced_drawing.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "render/beams/beam_picture.h"
#include "render/reference.h"
#include "render/work_meter.h"

namespace culet {

namespace {

constexpr std::array k_tolerances{0.2, 0.14, 0.1, 0.07, 0.05, 0.035, 0.025, 0.018, 0.013, 0.01};
// Work rises about as so a power of one over the tolerance.
constexpr double k_power = 1.5;
// Of what is left, what a next picture may take by that: it is a guess.
constexpr double k_share_of_rest = 0.6;

// The finest that is likely to fit in; 0: none.
double next_tolerance(double reached, double took, double left, double finest) {
    for (auto t = k_tolerances.rbegin(); t != k_tolerances.rend(); ++t) {
        const double tolerance = std::max(*t, finest);
        if (tolerance >= reached) return 0;
        if (took * std::pow(reached / tolerance, k_power) <= k_share_of_rest * left)
            return tolerance;
    }
    return 0;
}

}  // namespace

RenderResult draw_within_allowance(const Scene& scene, const Progress& progress,
                                   const DrawToTolerance& draw, const PictureSink& better) {
    const double allowed = scene.settings.allowed_ns, finest = scene.settings.tolerance;
    const auto meter = std::make_shared<WorkMeter>();
    meter->allow(allowed);
    meter->expect(allowed);
    const Progress counted = counted_by(progress, meter);
    Scene attempt = scene;
    attempt.settings.meter = meter;
    attempt.settings.allowed_ns = 0;
    attempt.settings.tolerance = std::max(k_tolerances.front(), finest);
    std::optional<RenderResult> best;
    for (;;) {
        const double tolerance = attempt.settings.tolerance;
        const double before = static_cast<double>(meter->spent());
        try {
            RenderResult result = draw(attempt, counted);
            if (!best || result.stats.error_bound < best->stats.error_bound) {
                best = std::move(result);
                best->stats.allowed_tolerance = tolerance;
                if (better) better(*best);
            }
        } catch (const OverAllowance&) {
            break;
        }
        const double spent = static_cast<double>(meter->spent());
        const double next = next_tolerance(tolerance, spent - before, allowed - spent, finest);
        if (!(next > 0)) break;
        attempt.settings.tolerance = next;
    }
    if (!best) {
        // Not even a coarse one: as coarse as it gets, and nobody knows how near.
        best = draw_quickly(scene, progress);
        if (better) better(*best);
    }
    return std::move(*best);
}

}  // namespace culet
