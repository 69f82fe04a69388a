#include "render/planner/error_estimate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "render/beams/frame_renderer.h"
#include "render/colour/colour_error.h"
#include "render/planner/wavelengths.h"
#include "render/work/work_meter.h"

namespace culet {

namespace {

constexpr std::size_t k_noise_pixels = 48;
constexpr double k_standard_errors = 3;
constexpr std::size_t k_step = 4;  // times as many pixels at the next look, at most
// Sides of the truth's grids, one after the other. Grids of different sides are off independently.
constexpr std::array k_sides{4, 5, 7, 11, 15, 22, 32, 46};
// Of a picture whose error, less a standard error, is this share of what it may be, no estimate is
// sought any further; less two, where that costs no more than this share of what it may. Few pixels
// that are off by much are often met too often.
constexpr double k_hopeless = 0.97, k_doubtful_share = 0.25;
// Noise that is more than this share of the difference hides what the picture is off by; finding it
// out may cost so many times as much as usual, because no other picture could be shown to be near
// enough, either.
constexpr double k_noisy = 0.5, k_noisy_price = 12;
// What the mean of N rays is off by falls about as N^-0.6; and of what a bound may be, what it
// should be by that to be sought.
constexpr double k_noise_power = 0.6, k_likely_room = 0.95;
// What the truth's paths are cut at, as a share of the tolerance.
constexpr double k_cut_share = 0.01;
// Outliers are pixels that have this share of the tolerance of the picture's light; so many do at
// most.
constexpr double k_outlier_share = 1.0 / 24;
constexpr std::size_t k_most_outliers = 96;
// What finding out about a single picture may cost: about two seconds of a processor.
constexpr double k_most_ns_at_once = 2e9;

}  // namespace

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
    // Interference depends on how wide the wavelengths' bands are.
    if (plan.on(Effects::coherence)) nodes_ = k_node_counts.back();
    // Other random paths than the picture's.
    limits_.seed = scene_.settings.seed + 1;
    limits_.depth = scene_.settings.depth > 0 ? scene_.settings.depth : k_deepest;
    limits_.cut_weight = branches ? tree_cut(tolerance) : std::max(k_cut_share * tolerance, 1e-7);
    limits_.split_weight = tree_split(tolerance);
    limits_.roulette = branches;
    work_ = work_along_paths(plan);
    levels_.resize(1);
    levels_[0].samples = grid(0);
}

// No grid that the scene asks for, whose picture would share the truth's rays.
int ErrorEstimator::grid(std::size_t level) const {
    int side = k_sides[level];
    if (side * side == scene_.settings.samples) side += level == 0 ? 2 : 1;
    return side * side;
}

bool ErrorEstimator::takes_grid(int side) {
    return std::find(k_sides.begin(), k_sides.end(), side) != k_sides.end();
}

int ErrorEstimator::samples() const {
    int sum = 0;
    for (const Level& level : levels_) sum += level.samples;
    return sum;
}

void ErrorEstimator::take_more() {
    if (levels_.size() == k_sides.size()) return;
    Level more;
    more.samples = grid(levels_.size());
    levels_.push_back(more);
}

double ErrorEstimator::more_ns() const {
    if (levels_.size() == k_sides.size() || !(rays_drawn_ > 0))
        return std::numeric_limits<double>::infinity();
    return static_cast<double>(levels_.front().rgb.size()) * grid(levels_.size()) *
           price_ns(work_) / rays_drawn_;
}

double ErrorEstimator::pixel_ns() const {
    return rays_drawn_ > 0 ? price_ns(work_) * samples() / rays_drawn_ : 0;
}

double ErrorEstimator::bands_of_a_ray() const {
    return static_cast<double>(nodes_) / turns_for(levels_.front().samples, nodes_);
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
    if (!noise_of_16_) noise_of_16_ = drawn_noise_of_16();
    return *noise_of_16_;
}

double ErrorEstimator::drawn_noise_of_16() {
    const PilotDrawing drawing = draw(some_.stretch(0, k_noise_pixels), levels_[0].samples);
    double squares = 0, sum = 0;
    for (double halves : drawing.halves_apart) {
        sum += halves;
        squares += halves * halves;
    }
    if (!(drawing.few_rays > 0)) return 0;
    // Few pixels easily miss the reflexes that are off most: one and a half standard errors more.
    const double count = static_cast<double>(drawing.halves_apart.size());
    const double spread = std::sqrt(std::max(0.0, squares * count - sum * sum) / count) / sum;
    return (1 + 1.5 * spread) * drawing.few_rays / k_halves_over_noise;
}

void ErrorEstimator::draw_up_to(std::size_t count) {
    count = std::min(count, chosen_.pixels.at.size());
    for (Level& level : levels_) {
        if (level.rgb.size() >= count) continue;
        const std::size_t first = level.rgb.size();
        const StonePixels more = chosen_.pixels.stretch(first, count - first);
        const PilotDrawing drawing = draw(more, level.samples);
        for (std::size_t i = 0; i < more.at.size(); ++i) {
            level.radiance += mean_of(drawing.rgb[i]) * chosen_.counts[first + i];
            level.halves += drawing.halves_apart[i] * chosen_.counts[first + i];
        }
        // What a depth leaves out that the scene names, the plan has bounded.
        const double lost = drawing.cut + (scene_.settings.depth > 0 ? 0 : drawing.remainder);
        level.cut += lost * static_cast<double>(more.at.size());
        level.rgb.insert(level.rgb.end(), drawing.rgb.begin(), drawing.rgb.end());
    }
    for (Level& level : levels_) {
        const std::size_t first = level.outliers.size();
        const StonePixels more = outliers_.stretch(first, outliers_.at.size() - first);
        if (more.at.empty()) continue;
        const PilotDrawing drawing = draw(more, level.samples);
        level.outliers.insert(level.outliers.end(), drawing.rgb.begin(), drawing.rgb.end());
    }
}

void ErrorEstimator::find_outliers(const Picture& picture) {
    of_picture_.clear();
    if (!chosen_.bright || chosen_.all) return;
    for (const auto& at :
         outstanding_pixels(picture, scene_.camera.optics.two_windows ? 2 : 1,
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
    const double all = samples();
    for (double& v : sum) v /= all;
    return sum;
}

double ErrorEstimator::noise_of(const Level& level) const {
    return level.halves / level.radiance / k_halves_over_noise;
}

CheckedSample ErrorEstimator::sample(std::size_t pixels) const {
    const Level& level = levels_.front();
    const std::size_t count = std::min(pixels, level.rgb.size());
    CheckedSample sample;
    sample.pixels = chosen_.pixels.stretch(0, count);
    sample.counts.assign(chosen_.counts.begin(), chosen_.counts.begin() + static_cast<long>(count));
    sample.truth.assign(level.rgb.begin(), level.rgb.begin() + static_cast<long>(count));
    sample.limits = limits_;
    sample.rays = level.samples;
    sample.nodes = nodes_;
    sample.noise = noise_of(level);
    return sample;
}

ErrorEstimate ErrorEstimator::look(const Picture& picture, std::size_t wanted) {
    draw_up_to(wanted);
    const std::size_t count = std::min(wanted, chosen_.pixels.at.size());
    ErrorEstimate estimate;
    estimate.pixels = static_cast<int>(count);
    estimate.samples = samples();
    std::vector<Rgb> seen, true_pixels;
    std::vector<double> errors_of;
    double errors = 0, squares = 0, sizes = 0;
    // A pixel of no number is as wrong as can be.
    const auto error_of = [](const Rgb& a, const Rgb& b) {
        const double error = apart(a, b);
        return std::isfinite(error) ? error : 1e100;
    };
    for (std::size_t i = 0; i < count; ++i) {
        const auto [x, y] = chosen_.pixels.at[i];
        seen.push_back(picture.pixel(x, y));
        true_pixels.push_back(truth(&Level::rgb, i));
        const double counts = of_picture_.contains({x, y}) ? 0 : chosen_.counts[i];
        const double error = counts * error_of(seen.back(), true_pixels.back());
        errors_of.push_back(error);
        errors += error;
        squares += error * error;
        sizes += counts * mean_of(true_pixels.back());
    }
    const double pixels = static_cast<double>(count);
    // Each of these is one of all.
    double surely = 0;
    for (const auto& [at, i] : of_picture_) {
        const Rgb there = truth(&Level::outliers, i);
        const double counts = pixels / chosen_.pixels.in_picture;
        surely += counts * error_of(picture.pixel(at.first, at.second), there);
        sizes += counts * mean_of(there);
    }
    if (!(sizes > 0)) return estimate;
    estimate.difference = (errors + surely) / sizes;
    if (!chosen_.all && count > 1) {
        const double mean = errors / pixels,
                     deviation = std::sqrt(std::max(0.0, squares - errors * mean) / (pixels - 1));
        estimate.spread = deviation * std::sqrt(pixels) / sizes;
        if (deviation > 0) {
            double cubes = 0;
            for (const double error : errors_of) {
                cubes += std::pow((error - mean) / deviation, 3) / pixels;
            }
            constexpr double t = k_standard_errors;
            estimate.skewness = std::max(0.0, cubes) * (1 + 2 * t * t) / 6 * deviation / sizes;
        }
    }
    double noise = 0, cut = 0;
    for (const Level& level : levels_) {
        const double share = static_cast<double>(level.samples) / samples();
        noise += std::pow(share * noise_of(level), 2);
        cut += share * level.cut / static_cast<double>(level.rgb.size());
    }
    estimate.noise = std::sqrt(noise);
    // What the truth itself has cut counts as light of the mean radiance.
    estimate.bound =
        estimate.difference + k_standard_errors * estimate.spread + estimate.skewness + cut;
    estimate.bound_delta_e = colour_error(seen, true_pixels).bound_delta_e();
    return estimate;
}

// Of so many pixels and grids, those that are not drawn yet.
double ErrorEstimator::rays_for(std::size_t pixels, std::size_t levels) const {
    double rays = 0;
    for (std::size_t l = 0; l < levels; ++l) {
        const bool there = l < levels_.size();
        const double have = there ? static_cast<double>(levels_[l].rgb.size()) : 0;
        rays += std::max(0.0, static_cast<double>(pixels) - have) *
                (there ? levels_[l].samples : grid(l));
    }
    return rays;
}

// The cheapest way to look that is likely to end it, were the picture better than what was found by
// so many of its standard errors: more pixels narrow the standard error, more rays lessen the
// noise.
std::optional<ErrorEstimator::Look> ErrorEstimator::next_look(const ErrorEstimate& estimate,
                                                              double room,
                                                              double standard_errors) const {
    const double error = std::max(0.0, estimate.error() - standard_errors * estimate.spread);
    std::optional<Look> best;
    const double rays_before = samples();
    double rays = rays_before;
    for (std::size_t levels = levels_.size();; ++levels) {
        const double noise = estimate.noise * std::pow(rays_before / rays, k_noise_power),
                     difference = std::hypot(error, noise);
        for (std::size_t pixels = static_cast<std::size_t>(estimate.pixels);;) {
            const double spread = estimate.spread * (difference / estimate.difference) *
                                  std::sqrt(estimate.pixels / static_cast<double>(pixels));
            const double skewness = estimate.skewness * (difference / estimate.difference) *
                                    (estimate.pixels / static_cast<double>(pixels));
            if (difference + k_standard_errors * spread + skewness <= k_likely_room * room) {
                const double drawn = rays_for(pixels, levels);
                // What is there already was not enough.
                if (drawn > 0 || pixels != static_cast<std::size_t>(estimate.pixels)) {
                    if (!best || drawn < best->rays) best = Look{pixels, levels, drawn};
                    break;
                }
            }
            if (pixels >= chosen_.pixels.at.size()) break;
            pixels = std::min(2 * pixels, chosen_.pixels.at.size());
        }
        if (levels == k_sides.size()) break;
        rays += grid(levels);
    }
    return best;
}

void ErrorEstimator::choose(const Picture& picture, FrameRenderer* frames) {
    chosen_ = choose_check_pixels(scene_, picture, some_, *progress_, frames);
    // A small light has an image at each wavelength. Where these part, few wavelengths bring too
    // much or too little of it, and a truth of the picture's own would not tell.
    if (chosen_.sun) nodes_ = k_node_counts.back();
}

void ErrorEstimator::look_elsewhere() {
    chosen_ = {};
    for (Level& level : levels_) {
        level.rgb.clear();
        level.halves = level.radiance = level.cut = 0;
    }
}

ErrorEstimate ErrorEstimator::estimate(const Picture& picture, double room, double most_ns,
                                       FrameRenderer* frames) {
    if (chosen_.pixels.at.empty()) choose(picture, frames);
    // What was drawn to judge other pictures judges this one.
    std::size_t known = chosen_.pixels.at.size();
    for (const Level& level : levels_) known = std::min(known, level.rgb.size());
    find_outliers(picture);
    ErrorEstimate estimate = look(picture, std::max(chosen_.first, known));
    for (int more = 1; more < k_looks && estimate.bound > room; ++more) {
        // As long as the noise is what is seen, the picture cannot be blamed.
        const bool noisy = estimate.noise > k_noisy * estimate.difference;
        const bool doubtful = !noisy && estimate.error() - estimate.spread > k_hopeless * room;
        if (doubtful && estimate.error() - 2 * estimate.spread > k_hopeless * room) break;
        const std::optional<Look> next = next_look(estimate, room, doubtful ? 2 : 1);
        if (!next) break;
        // On the way there it may be found out to be hopeless, or that a pixel that is off by much
        // is rarer than it seemed: what counts is the price of the next step.
        const std::size_t wanted =
            std::min(next->pixels, k_step * static_cast<std::size_t>(estimate.pixels));
        const double ray_ns = rays_drawn_ > 0 ? price_ns(work_) / rays_drawn_ : 0;
        const double share = noisy ? k_noisy_price : doubtful ? k_doubtful_share : 1;
        if (rays_for(wanted, next->levels) * ray_ns > share * most_ns) break;
        while (levels_.size() < next->levels) take_more();
        try {
            estimate = look(picture, wanted);
        } catch (const OverAllowance&) {
            break;  // what was found before stands
        }
    }
    return estimate;
}

ErrorEstimate estimate_error(const Scene& scene, const Picture& picture, const Progress& progress) {
    Scene window = scene;
    if (window.camera.optics.two_windows) window.camera.width /= 2;
    const StonePixels some = stone_pixels(window, k_noise_pixels);
    if (some.at.empty()) {
        ErrorEstimate none;
        none.bound = std::numeric_limits<double>::quiet_NaN();
        return none;
    }
    const double tolerance = scene.settings.tolerance;
    return ErrorEstimator(window, some, tolerance, progress)
        .estimate(picture, tolerance, k_most_ns_at_once);
}

}  // namespace culet
