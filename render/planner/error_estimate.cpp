#include "render/planner/error_estimate.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "render/beams/frame_renderer.h"
#include "render/colour/colour_error.h"
#include "render/planner/policy.h"
#include "render/planner/wavelengths.h"
#include "render/work/work_meter.h"

namespace culet {

double ErrorEstimate::error() const {
    return std::sqrt(std::max(0.0, difference * difference - noise * noise));
}

ErrorEstimator::ErrorEstimator(const Scene& scene, StonePixels some, double tolerance,
                               const Progress& progress)
    : scene_(scene),
      some_(std::move(some)),
      nodes_(k_node_counts[tolerance < k_fine_tolerance ? 3 : 2]),
      progress_(&progress) {
    const OpticalSetup plan = make_optical_setup(scene_, nodes_);
    const bool branches = paths_branch(scene_, plan);
    // Interference depends on the bandwidth of each wavelength.
    if (plan.on(Effects::coherence)) nodes_ = k_node_counts.back();
    // Random paths other than the picture's.
    limits_.seed = scene_.settings.seed + 1;
    limits_.depth = scene_.settings.depth > 0 ? scene_.settings.depth : k_deepest;
    limits_.cut_weight = branches ? tree_cut(tolerance) : std::max(k_truth_cut * tolerance, 1e-7);
    limits_.split_weight = tree_split(tolerance);
    limits_.roulette = branches;
    work_ = work_along_paths(plan);
    take_more();
}

// Avoids the scene's own grid: its picture would share the truth's rays.
int ErrorEstimator::grid(std::size_t level) const {
    int side = k_truth_sides[level];
    if (side * side == scene_.settings.samples) side += level == 0 ? 2 : 1;
    return side * side;
}

int ErrorEstimator::samples() const {
    int sum = 0;
    for (const Level& level : levels_) sum += level.samples;
    return sum;
}

void ErrorEstimator::take_more() {
    if (levels_.size() == k_truth_sides.size()) return;
    const int samples = grid(levels_.size());
    levels_.emplace_back().samples = samples;
}

double ErrorEstimator::band_ns() const {
    return work_.rays > 0 ? price_ns(work_) / work_.rays : 0;
}

PilotDrawing ErrorEstimator::draw(const StonePixels& pixels, int samples) {
    Scene scene = scene_;
    scene.settings.wavelength_turns = turns_for(samples, nodes_);
    PilotDrawing drawing = draw_pilot(scene, pixels, limits_, samples, nodes_, *progress_);
    work_.rays += drawing.rays;
    work_.events += drawing.events;
    rays_drawn_ += static_cast<double>(pixels.at.size()) * samples;
    return drawing;
}

double ErrorEstimator::noise_of_16() {
    if (noise_of_16_) return *noise_of_16_;
    const PilotDrawing drawing = draw(some_.range(0, k_first_pixels), levels_[0].samples);
    double squares = 0, sum = 0;
    for (double halves : drawing.halves_apart) {
        sum += halves;
        squares += halves * halves;
    }
    noise_of_16_ = 0;
    if (!(drawing.few_rays > 0)) return 0;
    // Few pixels easily miss the reflexes with the largest errors: add 1.5 standard errors.
    const double count = static_cast<double>(drawing.halves_apart.size());
    const double standard_error =
        std::sqrt(std::max(0.0, squares * count - sum * sum) / count) / sum;
    noise_of_16_ = (1 + 1.5 * standard_error) * drawing.few_rays / k_halves_over_noise *
                   std::pow(levels_[0].samples / 16.0, k_power_of_rays);
    return *noise_of_16_;
}

void ErrorEstimator::draw_up_to(std::size_t count) {
    count = std::min(count, chosen_.pixels.at.size());
    for (Level& level : levels_) {
        if (level.rgb.size() >= count) continue;
        const std::size_t first = level.rgb.size();
        const StonePixels more = chosen_.pixels.range(first, count - first);
        const PilotDrawing drawing = draw(more, level.samples);
        for (std::size_t i = 0; i < more.at.size(); ++i) {
            level.radiance += mean_of(drawing.rgb[i]) * chosen_.weights[first + i];
            level.halves += drawing.halves_apart[i] * chosen_.weights[first + i];
        }
        // The plan already bounds the error of a depth that the scene names.
        const double lost = drawing.cut + (scene_.settings.depth > 0 ? 0 : drawing.remainder);
        level.cut += lost * static_cast<double>(more.at.size());
        level.rgb.insert(level.rgb.end(), drawing.rgb.begin(), drawing.rgb.end());
    }
    for (Level& level : levels_) {
        const std::size_t first = level.outliers.size();
        const StonePixels more = outliers_.range(first, outliers_.at.size() - first);
        if (more.at.empty()) continue;
        const PilotDrawing drawing = draw(more, level.samples);
        level.outliers.insert(level.outliers.end(), drawing.rgb.begin(), drawing.rgb.end());
    }
}

void ErrorEstimator::find_outliers(const Picture& picture) {
    of_picture_.clear();
    if (!chosen_.bright || chosen_.all) return;
    for (const auto& at :
         bright_outliers(picture, scene_.camera.optics.two_windows ? 2 : 1,
                         k_outlier_share * scene_.settings.tolerance, k_most_outliers)) {
        const auto before = std::find(outliers_.at.begin(), outliers_.at.end(), at);
        of_picture_[at] = static_cast<std::size_t>(before - outliers_.at.begin());
        if (before == outliers_.at.end()) outliers_.at.push_back(at);
    }
}

Rgb ErrorEstimator::truth(std::vector<Rgb> Level::*of, std::size_t pixel) const {
    Rgb sum{};
    for (const Level& level : levels_) {
        for (std::size_t c = 0; c < 3; ++c) sum[c] += level.samples * (level.*of)[pixel][c];
    }
    for (double& v : sum) v /= samples();
    return sum;
}

double ErrorEstimator::noise_of(const Level& level) const {
    return level.halves / level.radiance / k_halves_over_noise;
}

double ErrorEstimator::without_effects(const std::array<bool, k_effect_count>& effects,
                                       int pixels) {
    Scene without = scene_;
    without.settings.effects_auto = false;
    without.settings.effects = effects;
    const OpticalSetup whole = make_optical_setup(scene_, nodes_),
                       left = make_optical_setup(without, nodes_);
    bool leaves_out = false;
    for (int e = 0; e < k_effect_count; ++e)
        leaves_out |= whole.on(static_cast<Effects>(e)) && !left.on(static_cast<Effects>(e));
    if (!leaves_out) return 0;
    const Level& level = levels_.front();
    without.settings.wavelength_turns = turns_for(level.samples, nodes_);
    const StonePixels some = chosen_.pixels.range(0, static_cast<std::size_t>(pixels));
    const std::vector<Rgb> seen =
        draw_pilot(without, some, limits_, level.samples, nodes_, *progress_).rgb;
    double errors = 0, sizes = 0;
    for (std::size_t i = 0; i < seen.size(); ++i) {
        errors += chosen_.weights[i] * apart(seen[i], level.rgb[i]);
        sizes += chosen_.weights[i] * mean_of(level.rgb[i]);
    }
    if (!(sizes > 0)) return 0;
    const double off = errors / sizes, noise = noise_of(level);
    return std::sqrt(std::max(0.0, off * off - noise * noise));
}

namespace {

// The mean's standard error and its skewness correction; `sizes`: sum of the radiance.
void add_scatter(const std::vector<double>& errors, double sum, double squares, double sizes,
                 ErrorEstimate& estimate) {
    const double pixels = static_cast<double>(errors.size()), mean = sum / pixels,
                 deviation = std::sqrt(std::max(0.0, squares - sum * mean) / (pixels - 1));
    estimate.standard_error = deviation * std::sqrt(pixels) / sizes;
    if (!(deviation > 0)) return;
    double cubes = 0;
    for (const double error : errors) cubes += std::pow((error - mean) / deviation, 3) / pixels;
    constexpr double t = k_standard_errors;
    estimate.skewness = std::max(0.0, cubes) * (1 + 2 * t * t) / 6 * deviation / sizes;
}

}  // namespace

ErrorEstimate ErrorEstimator::look(const Picture& picture, std::size_t wanted) {
    draw_up_to(wanted);
    const std::size_t count = std::min(wanted, chosen_.pixels.at.size());
    ErrorEstimate estimate;
    estimate.pixels = static_cast<int>(count);
    estimate.samples = samples();
    std::vector<Rgb> seen, true_pixels;
    std::vector<double> errors_of;
    double errors = 0, squares = 0, sizes = 0;
    // Non-finite pixels count as a huge error.
    const auto error_of = [](const Rgb& a, const Rgb& b) {
        const double error = apart(a, b);
        return std::isfinite(error) ? error : 1e100;
    };
    for (std::size_t i = 0; i < count; ++i) {
        const auto [x, y] = chosen_.pixels.at[i];
        seen.push_back(picture.pixel(x, y));
        true_pixels.push_back(truth(&Level::rgb, i));
        const double weight = of_picture_.contains({x, y}) ? 0 : chosen_.weights[i];
        const double error = weight * error_of(seen.back(), true_pixels.back());
        errors_of.push_back(error);
        errors += error;
        squares += error * error;
        sizes += weight * mean_of(true_pixels.back());
    }
    const double pixels = static_cast<double>(count);
    // Each outlier represents one pixel of the picture.
    double surely = 0;
    for (const auto& [at, i] : of_picture_) {
        const Rgb there = truth(&Level::outliers, i);
        const double weight = pixels / chosen_.pixels.in_picture;
        surely += weight * error_of(picture.pixel(at.first, at.second), there);
        sizes += weight * mean_of(there);
    }
    if (!(sizes > 0)) return estimate;
    estimate.difference = (errors + surely) / sizes;
    if (!chosen_.all && count > 1) add_scatter(errors_of, errors, squares, sizes, estimate);
    double noise = 0, cut = 0;
    for (const Level& level : levels_) {
        const double share = static_cast<double>(level.samples) / samples();
        noise += std::pow(share * noise_of(level), 2);
        cut += share * level.cut / static_cast<double>(level.rgb.size());
    }
    estimate.noise = std::sqrt(noise);
    // Light that the truth itself cut counts with the mean radiance.
    estimate.bound =
        estimate.difference + k_standard_errors * estimate.standard_error + estimate.skewness + cut;
    estimate.bound_delta_e = colour_error(seen, true_pixels).bound_delta_e();
    return estimate;
}

void ErrorEstimator::choose(const Picture& picture, FrameRenderer* frames) {
    chosen_ = choose_check_pixels(scene_, picture, some_, *progress_, frames);
    // A sun has an image per wavelength. Where these separate, few wavelengths show too much or too
    // little of it, in the picture and in a truth with the same wavelengths.
    if (chosen_.sun) nodes_ = k_node_counts.back();
}

void ErrorEstimator::forget_pixels() {
    chosen_ = {};
    for (Level& level : levels_) {
        level.rgb.clear();
        level.halves = level.radiance = level.cut = 0;
    }
}

ErrorEstimate ErrorEstimator::estimate(const Picture& picture, double room, double most_ns,
                                       FrameRenderer* frames) {
    if (chosen_.pixels.at.empty()) choose(picture, frames);
    // Pixels drawn for other pictures serve this one, too.
    std::size_t known = chosen_.pixels.at.size();
    for (const Level& level : levels_) known = std::min(known, level.rgb.size());
    find_outliers(picture);
    ErrorEstimate estimate = look(picture, std::max(chosen_.first, known));
    for (int more = 1; more < k_looks && estimate.bound > room; ++more) {
        // While noise dominates, the picture may be right.
        const bool noisy = estimate.noise > 0.5 * estimate.difference;
        // Assume that the picture is better than found by one standard error. If error and noise
        // leave room, more pixels narrow the standard error; else more rays lower the noise. The
        // next step may show that the picture is hopeless, or that a large error is rarer than it
        // seemed, so only that step's price counts.
        const double error = std::max(0.0, estimate.error() - estimate.standard_error),
                     rest = 0.95 * room - std::hypot(error, estimate.noise);
        if (!noisy && error > room) break;
        const double pixels = estimate.pixels, all = static_cast<double>(chosen_.pixels.at.size());
        const bool rays = pixels >= all || (rest <= 0 && estimate.noise > error);
        if (rays && (levels_.size() == k_truth_sides.size() || !(estimate.noise > 0))) break;
        double wanted = rays ? pixels : std::min(4 * pixels, all);
        if (!rays && rest > 0)
            wanted = std::min(
                wanted,
                pixels * std::max(2.0, std::pow((estimate.bound - estimate.difference) / rest, 2)));
        const double ray_ns = rays_drawn_ > 0 ? price_ns(work_) / rays_drawn_ : 0,
                     drawn = rays ? pixels * grid(levels_.size()) : (wanted - pixels) * samples();
        if (drawn * ray_ns > (noisy ? k_noisy_price : 1) * most_ns) break;
        if (rays) take_more();
        try {
            estimate = look(picture, static_cast<std::size_t>(wanted));
        } catch (const OverBudget&) {
            break;  // keep the last estimate
        }
    }
    return estimate;
}

ErrorEstimate estimate_error(const Scene& scene, const Picture& picture, const Progress& progress) {
    Scene window = scene;
    if (window.camera.optics.two_windows) window.camera.width /= 2;
    const StonePixels some = stone_pixels(window, k_first_pixels);
    if (some.at.empty()) return {.bound = std::numeric_limits<double>::quiet_NaN()};
    const double tolerance = scene.settings.tolerance;
    // About two seconds of processor time.
    return ErrorEstimator(window, some, tolerance, progress).estimate(picture, tolerance, 2e9);
}

}  // namespace culet
