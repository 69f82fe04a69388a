#include "render/planner/time_budget.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "render/engine/engine.h"
#include "render/planner/pilot_picture.h"
#include "render/planner/policy.h"
#include "render/planner/quick_picture.h"
#include "render/planner/wavelengths.h"
#include "render/reference/prepared_scene.h"
#include "render/work/price.h"
#include "render/work/work_meter.h"

namespace culet {

namespace {

// Evenly spread pixels (Roberts 2018, R2).
StonePixels some_pixels(const Camera& camera) {
    StonePixels pixels;
    for (int i = 0; i < k_counted_pixels; ++i) {
        pixels.at.emplace_back(
            static_cast<int>(camera.width * std::fmod(0.7548776662466927 * i, 1.0)),
            static_cast<int>(camera.height * std::fmod(0.5698402909980532 * i, 1.0)));
    }
    pixels.in_picture = static_cast<double>(camera.width) * camera.height;
    return pixels;
}

struct Pilot {
    double ns = 0, noise = 0;
};
Pilot pilot_with(Scene scene, int samples, const Progress& progress) {
    const PreparedScene prepared(scene);
    scene.settings.wavelengths_nm = prepared.setup.wavelengths_nm;
    const StonePixels pixels = some_pixels(scene.camera);
    const PilotDrawing drawing =
        draw_pilot(scene, pixels, prepared.limits, samples, k_node_counts[1], progress);
    PathWork work = work_along_paths(prepared.setup);
    work.rays = drawing.rays;
    work.events = drawing.events;
    const double share = static_cast<double>(pixels.at.size()) / pixels.in_picture;
    return {(price_ns(work) + drawing.surroundings_ns) / share,
            drawing.few_rays / k_halves_over_noise};
}

// Returns 0 if not even one fits. Rays share the wavelengths, so work is not proportional to rays,
// and each guess starts from the one before.
int samples_within(const Scene& scene, double allowed_ns, const Progress& progress) {
    int samples = 16, within = 0;
    for (int guess = 0; guess < 4; ++guess) {
        const Pilot pilot = pilot_with(scene, samples, progress);
        if (pilot.ns <= allowed_ns) within = std::max(within, samples);
        // The error of random rays falls as the root of their number; one ray gives no estimate.
        // Edges need 16 rays even without noise.
        const double enough =
            samples > 1
                ? std::max(samples * std::pow(pilot.noise / scene.settings.tolerance, 2), 16.0)
                : k_most_samples;
        const double likely = std::min(
            {samples * allowed_ns / pilot.ns, enough, static_cast<double>(k_most_samples)});
        // A square number makes a regular grid.
        const int side = std::max(1, static_cast<int>(std::sqrt(likely)));
        if (side * side == samples || side * side == within) break;
        samples = side * side;
    }
    return within;
}

// The tolerance that `left` allows, after a picture within `reached` took `took`; at least `least`.
// Nothing if it would not be much finer.
std::optional<double> finer_tolerance(double reached, double took, double left, double least) {
    if (!(left > 0)) return std::nullopt;
    const double affordable =
        reached * std::pow(std::max(took, 1.0) / (k_share_of_rest * left), 1 / k_power_of_work);
    const double tolerance = std::max(affordable, least);
    if ((tolerance == least && reached > least) || reached / tolerance >= k_worth_drawing)
        return tolerance;
    return std::nullopt;
}

}  // namespace

RenderResult draw_within_budget(const Scene& scene, const Progress& progress,
                                const DrawToTolerance& draw, const PictureSink& better) {
    const double finest = scene.settings.tolerance;
    double allowed = scene.settings.allowed_ns;
    const auto meter = std::make_shared<WorkMeter>();
    const Progress counted = counted_by(progress, meter);
    Scene attempt = scene;
    attempt.settings.meter = meter;
    attempt.settings.allowed_ns = 0;
    std::optional<RenderResult> best;
    double spent = 0;
    std::optional<double> next = std::max(k_first_tolerance, finest);
    while (next) {
        const double tolerance = attempt.settings.tolerance = *next;
        meter->allow(allowed);
        meter->expect(allowed);
        double bound = std::numeric_limits<double>::infinity();
        try {
            RenderResult result = draw(attempt, counted);
            bound = result.stats.error_bound;
            if (!best || bound < best->stats.error_bound) {
                best = std::move(result);
                best->stats.allowed_tolerance = tolerance;
                if (better) better(*best);
            }
        } catch (const OverBudget&) {
        }
        // How far an abandoned picture got depends on chance: count all the work allowed.
        if (meter->over()) meter->use_up();
        const double took = static_cast<double>(meter->spent()) - spent;
        spent += took;
        next.reset();
        const bool usual = allowed == k_usual_budget_ns;
        if (bound <= tolerance) {
            const double reached = std::max(bound, finest);
            next = finer_tolerance(reached, took, allowed - spent, std::max(reached / 2, finest));
            if (usual && next.value_or(reached) > k_rough) {
                allowed = k_run_budget_ns;
                next = finer_tolerance(reached, took, allowed - spent, finest);
            }
        } else if (usual && !best) {
            allowed = k_run_budget_ns;
            next = tolerance;
        }
    }
    if (!best) {
        // Not even a coarse picture fitted: draw the coarsest, with unknown error.
        best = draw_quickly(scene, progress);
        if (better) better(*best);
    }
    return std::move(*best);
}

bool leaves_samples_open(const Scene& scene) {
    return scene.has_objects() && scene.settings.samples == 0 &&
           engine_of(scene.settings).approaches_truth();
}

Scene with_allowed_samples(const Scene& whole, const Progress& progress) {
    Scene scene = whole;
    const double allowed = k_share_of_rest * whole.settings.allowed_ns;
    RenderSettings& settings = scene.settings;
    settings.allowed_ns = 0;
    // The two windows of a dichroscope show one view twice.
    const auto samples = [&] {
        Scene window = scene;
        if (window.camera.optics.two_windows) window.camera.width /= 2;
        return samples_within(window, allowed, progress);
    };
    settings.samples = samples();
    if (settings.samples == 0 && settings.wavelengths_nm.empty()) {
        settings.wavelengths_nm = k_three_nm;
        settings.samples = samples();
    }
    if (settings.samples == 0 && settings.effects_auto) {
        settings.effects_auto = false;
        settings.effects[static_cast<std::size_t>(Effects::birefringence)] = false;
        settings.samples = samples();
    }
    settings.samples = std::max(settings.samples, 1);
    return scene;
}

}  // namespace culet
