#include "render/planner/truth.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "render/colour/colour_error.h"
#include "render/planner/verify.h"
#include "render/planner/wavelengths.h"

namespace culet {

namespace {

constexpr int k_verified_samples = 64, k_least_nodes = 29;

Scene one_window(const Scene& scene) {
    Scene one = scene;
    if (one.camera.optics.two_windows) one.camera.width /= 2;
    return one;
}

}  // namespace

Truth draw_truth(const Scene& scene, const ScenePlan& plan, int pixels, int samples,
                 const Progress& progress) {
    return draw_truth(scene, plan, stone_pixels(one_window(scene), pixels), samples, progress);
}

Truth draw_truth(const Scene& scene, const ScenePlan& plan, StonePixels pixels, int samples,
                 const Progress& progress) {
    Scene whole = one_window(scene);
    RenderSettings& settings = whole.settings;
    settings.effects_auto = true;
    settings.wavelength_turns = turns_for(samples, k_node_counts.back());
    PathLimits limits;
    limits.seed = settings.seed + 1;
    limits.depth = k_deepest;
    const bool branches = paths_branch(whole);
    const double cut = plan.settings.cut_weight.value_or(1e-4);
    limits.cut_weight = branches ? 1e-3 : std::min(1e-4, cut / 64);
    limits.split_weight = 0.05;
    limits.roulette = branches;
    const int nodes = static_cast<int>(plan.settings.wavelengths_nm.size()) < k_least_nodes
                          ? k_least_nodes
                          : k_node_counts.back();
    Truth truth;
    truth.samples = samples;
    truth.pixels = std::move(pixels);
    truth.drawing = draw_pilot(whole, truth.pixels, limits, samples, nodes, progress);
    return truth;
}

Verification compare_with_truth(const Truth& truth, const Picture& picture) {
    std::vector<Rgb> seen;
    for (const auto& [x, y] : truth.pixels.at) seen.push_back(picture.pixel(x, y));
    const ColourError error = colour_error(seen, truth.drawing.rgb);
    Verification result;
    result.pixels = static_cast<int>(seen.size());
    result.samples = truth.samples;
    result.difference = error.radiance;
    result.standard_error = error.radiance_spread;
    result.delta_e = error.delta_e;
    result.noise = truth.drawing.few_rays / k_halves_over_noise;
    result.measured = std::sqrt(
        std::max(0.0, result.difference * result.difference - result.noise * result.noise));
    return result;
}

Verification verify(const Scene& scene, const RenderResult& result, int pixels,
                    const Progress& progress) {
    const auto start = std::chrono::steady_clock::now();
    ScenePlan plan;
    plan.settings = scene.settings;
    if (result.stats.plan) plan = *result.stats.plan;
    plan.settings.wavelengths_nm = result.stats.wavelengths_nm;
    const int samples = std::clamp(4 * plan.settings.samples, k_verified_samples, 256);
    const Truth truth = draw_truth(scene, plan, pixels, samples, progress);
    Verification found = compare_with_truth(truth, result.picture);
    found.bound = result.stats.error_bound;
    if (result.stats.plan) found.bound_delta_e = result.stats.plan->bound_delta_e;
    found.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return found;
}

}  // namespace culet
