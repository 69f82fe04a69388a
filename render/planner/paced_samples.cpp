#include "render/planner/paced_samples.h"

#include <algorithm>
#include <cmath>

#include "render/engine/engine.h"
#include "render/planner/pilot_picture.h"
#include "render/planner/wavelengths.h"
#include "render/reference/prepared_scene.h"
#include "render/work/price.h"

namespace culet {

namespace {

constexpr int k_counted_pixels = 256, k_first_samples = 16, k_most_samples = 4096;
// Guesses from the one before: rays share the wavelengths, so that work is not in proportion.
constexpr int k_most_guesses = 4;
// Of what is allowed, what the picture may take; a few pixels tell only about what all of them do.
constexpr double k_share = 0.8;

// Spread evenly (Roberts 2018, R2).
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

// What a picture takes with so many rays a pixel, and how noisy it is.
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

// 0: not even one.
int samples_within(const Scene& scene, double allowed_ns, const Progress& progress) {
    int samples = k_first_samples, within = 0;
    for (int guess = 0; guess < k_most_guesses; ++guess) {
        const Pilot pilot = pilot_with(scene, samples, progress);
        if (pilot.ns <= allowed_ns) within = std::max(within, samples);
        // The mean of random rays is off by one over the root of their number; a single one does
        // not tell. Without noise there are edges still.
        const double enough =
            samples > 1 ? std::max(samples * std::pow(pilot.noise / scene.settings.tolerance, 2),
                                   static_cast<double>(k_first_samples))
                        : k_most_samples;
        const double likely = std::min(
            {samples * allowed_ns / pilot.ns, enough, static_cast<double>(k_most_samples)});
        // A square number is a regular grid.
        const int side = std::max(1, static_cast<int>(std::sqrt(likely)));
        if (side * side == samples || side * side == within) break;
        samples = side * side;
    }
    return within;
}

}  // namespace

bool leaves_samples_open(const Scene& scene) {
    return scene.furnished() && scene.settings.samples == 0 &&
           engine_of(scene.settings).approaches_truth();
}

Scene with_allowed_samples(const Scene& whole, const Progress& progress) {
    Scene scene = whole;
    const double allowed = k_share * whole.settings.allowed_ns;
    RenderSettings& settings = scene.settings;
    settings.allowed_ns = 0;
    // The two windows of a dichroscope are one view, seen twice.
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
