#include "compare/study/study_reference.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "compare/study/picture_error.h"
#include "compare/study/study_design.h"
#include "render/setup/optical_setup.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

constexpr std::array k_sizes{256, 192, 128, 96, 64};
// Rays per pixel of the two halves: this number squared, on a regular grid, and one less in another
// pattern.
constexpr std::array k_sides{2, 3, 4, 5, 7, 9, 11, 13, 17, 21, 27, 33, 43, 55};
constexpr int k_most_side = 64;
constexpr int k_wanted_rays = 64;
constexpr int k_probe = 24, k_probe_rays = 4;
// Pruning may change the reference by a third of the finest tolerance, a bound that is seldom
// reached; its noise should be well below.
constexpr double k_of_finest = 1.0 / 3, k_quiet = 0.1, k_rough_tolerance = 0.03;

Scene exact_scene(const Scene& scene, double finest_tolerance, int samples) {
    Scene exact = scene;
    exact.settings = exact_settings(scene, k_of_finest * finest_tolerance, k_node_counts.back());
    exact.settings.samples = samples;
    return exact;
}

// Few wavelengths and short paths: cheap, and close to the exact picture ray by ray. Nothing where
// that would save little.
std::optional<RenderSettings> rough_settings(const Scene& scene, const RenderStats& exact) {
    const RenderSettings rough = exact_settings(scene, k_rough_tolerance, k_node_counts.front());
    if (2 * rough.wavelengths_nm.size() > exact.wavelengths_nm.size() + 1) return std::nullopt;
    return rough;
}

// a x + b y
Picture sum_of(float a, const Picture& x, float b, const Picture& y) {
    Picture sum = x;
    for (std::size_t i = 0; i < sum.rgb.size(); ++i) sum.rgb[i] = a * x.rgb[i] + b * y.rgb[i];
    for (std::size_t i = 0; i < sum.coverage.size() && i < y.coverage.size(); ++i)
        sum.coverage[i] = a * x.coverage[i] + b * y.coverage[i];
    return sum;
}

struct Half {
    Picture picture;
    RenderStats stats;
    int rays = 0, rough_rays = 0;
};

// Many cheap rays, plus the mean difference of exact and cheap rays along the same paths: unbiased,
// with the noise of many (control variates; Giles 2008). `fewer` changes the rays' pattern.
Half half_of(const Scene& scene, double finest_tolerance, int side, int fewer,
             const Progress& progress) {
    Half half;
    half.rays = side * side - fewer;
    RenderResult exact = render(exact_scene(scene, finest_tolerance, half.rays), progress);
    half.stats = std::move(exact.stats);
    half.picture = std::move(exact.picture);
    const std::optional<RenderSettings> settings = rough_settings(scene, half.stats);
    if (!settings) return half;
    // Spend about as much time on the cheap rays as on the exact ones.
    const double times = std::sqrt(static_cast<double>(half.stats.wavelengths_nm.size()) /
                                   static_cast<double>(settings->wavelengths_nm.size()));
    const int rough_side = std::min(k_most_side, side * (1 + static_cast<int>(std::lround(times))));
    half.rough_rays = rough_side * rough_side - fewer;
    Scene rough = scene;
    rough.settings = *settings;
    rough.settings.samples = half.rays;
    const Picture same_rays = render(rough, progress).picture;
    rough.settings.samples = half.rough_rays;
    const Picture many_rays = render(rough, progress).picture;
    half.picture = sum_of(1, many_rays, 1, sum_of(1, half.picture, -1, same_rays));
    half.picture.coverage = many_rays.coverage;
    return half;
}

void take(Half& first, Half& second, StudyReference& reference) {
    const PictureMetric metric(sum_of(0.5f, first.picture, 0.5f, second.picture));
    if (metric.stone_pixels() == 0 || first.stats.rays == 0)
        throw InputError("the camera does not see the stone: there is nothing to study");
    reference.samples = first.rays + second.rays;
    reference.control_samples = first.rough_rays + second.rough_rays;
    reference.stats = std::move(first.stats);
    // The mean differs from either half by half their difference.
    reference.noise = metric.error_of(first.picture);
    reference.picture = metric.truth();
    reference.stone_pixels = metric.stone_pixels();
    reference.mean_radiance = metric.mean_radiance();
    reference.white = metric.white();
}

struct Spent {
    double now = 0, round = 0, most = 0;  // seconds: so far, in the last round, and allowed
};

// The finest side that there is time for, and that the noise needs.
std::size_t next_side(std::size_t at, const Spent& spent, double noise, double target) {
    const double side = k_sides[at];
    std::size_t next = at;
    while (next + 1 < k_sides.size()) {
        const double more = std::pow(k_sides[next + 1] / side, 2);
        if (spent.now + spent.round * more > spent.most) break;
        // Noise falls with the square root of the number of rays, or faster.
        const double fewer = std::pow(k_sides[next] / side, 2);
        if (next > at && noise <= target * std::sqrt(fewer)) break;
        ++next;
    }
    return next;
}

}  // namespace

Camera resized(const Camera& camera, int longer_side) {
    Camera small = camera;
    const double scale = static_cast<double>(longer_side) / std::max(camera.width, camera.height);
    const auto scaled = [&](int side) {
        return std::max(1, static_cast<int>(std::lround(scale * side)));
    };
    // The two windows of a dichroscope keep equal sizes.
    const int windows = camera.optics.two_windows ? 2 : 1;
    small.width = windows * scaled(camera.width / windows);
    small.height = scaled(camera.height);
    if (small.principal_point) {
        (*small.principal_point)[0] *= static_cast<double>(small.width) / camera.width;
        (*small.principal_point)[1] *= static_cast<double>(small.height) / camera.height;
    }
    return small;
}

int affordable_size(const Scene& scene, double tolerance, double seconds, StudyClock& clock) {
    const int longer = std::max(scene.camera.width, scene.camera.height);
    if (!std::isfinite(seconds)) return std::min(longer, k_sizes.front());
    Scene probe = exact_scene(scene, tolerance, k_probe_rays);
    probe.camera = resized(scene.camera, std::min(longer, k_probe));
    const double before = clock.spent();
    const bool quick =
        clock.within(seconds, [&](const Progress& progress) { render(probe, progress); });
    const double pixels = static_cast<double>(probe.camera.width) * probe.camera.height;
    const double of_ray = (clock.spent() - before) / (pixels * k_probe_rays);
    for (const int size : k_sizes) {
        const Camera camera = resized(scene.camera, std::min(longer, size));
        const double rays = static_cast<double>(camera.width) * camera.height * k_wanted_rays;
        if ((quick && of_ray * rays <= seconds) || size == k_sizes.back())
            return std::min(longer, size);
    }
    return k_sizes.back();
}

StudyReference study_reference(const Scene& scene, double finest_tolerance, double seconds,
                               StudyClock& clock) {
    StudyReference reference;
    const double begin = clock.spent();
    reference.tolerance = k_of_finest * finest_tolerance;
    const std::string too_dear =
        fmt::format("more rays would take over {:.0f} s of processor time", seconds);
    // A few rays show what more will cost and gain; then draws as many as there is time for.
    for (std::size_t at = 0;;) {
        const int side = k_sides[at];
        const double spent = clock.spent() - begin;
        // The first round is needed, however long it takes.
        const double allowed =
            at == 0 ? std::numeric_limits<double>::infinity() : 1.5 * seconds - spent;
        Half first, second;
        const bool done = clock.within(allowed, [&](const Progress& progress) {
            Scene half = scene;
            first = half_of(half, finest_tolerance, side, 0, progress);
            ++half.settings.seed;
            second = half_of(half, finest_tolerance, side, 1, progress);
        });
        if (!done) {
            reference.ended = too_dear;
            break;
        }
        take(first, second, reference);
        const double target = k_quiet * finest_tolerance;
        if (reference.noise.mean <= target) {
            reference.ended = "its noise is a tenth of the finest tolerance";
            break;
        }
        const double now = clock.spent() - begin, took = now - spent;
        const std::size_t next = next_side(at, {now, took, seconds}, reference.noise.mean, target);
        if (next == at) {
            reference.ended =
                at + 1 < k_sides.size() ? too_dear : "it has as many rays as a study takes";
            break;
        }
        at = next;
    }
    reference.cpu_seconds = clock.spent() - begin;
    return reference;
}

}  // namespace culet
