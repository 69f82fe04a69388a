#include "render/render.h"

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <mutex>
#include <nlohmann/json.hpp>

#include "render/scene_checks.h"
#include "stone/errors.h"

namespace culet {

namespace {

constexpr int k_deepest = 64;       // by tolerance; what is left then is reported as remainder
constexpr int k_tile = 16;          // pixels
constexpr int k_pilot_pixels = 24;  // along the picture's longer side
// Crystals: a path splits in two at every hit while it carries more than this.
constexpr double k_split_weight = 0.02;

// Adds up what the leaves of one ray see.
class Gather {
public:
    Gather(const LightField& lights, const Band& band, double* radiance)
        : lights_(lights), band_(band), radiance_(radiance) {}

    void leaf(const Vec3& at, const Vec3& direction, const NodeWeights& weight, const PathTrace&) {
        NodeWeights seen{};
        lights_.add_radiance(at, direction, 1.0, band_.first, band_.count, seen.data());
        for (int i = 0; i < band_.count; ++i) radiance_[band_.first + i] += weight[i] * seen[i];
    }
    void remainder(const NodeWeights& weight) { add(remainder_, weight); }
    void absorbed(const NodeWeights& weight) { add(absorbed_, weight); }
    void cut(const NodeWeights& weight) { add(cut_, weight); }

    double remainder_ = 0, absorbed_ = 0, cut_ = 0;

private:
    void add(double& sum, const NodeWeights& weight) const {
        for (int i = 0; i < band_.count; ++i) sum += weight[i];
    }
    const LightField& lights_;
    const Band& band_;
    double* radiance_;
};

// Additive recurrence with the generalised golden ratio in four dimensions (Roberts 2018), the same
// in every pixel and every run.
struct SamplePoint {
    double x, y, pupil_x, pupil_y;
};
std::vector<SamplePoint> sample_pattern(int count, bool pupil) {
    std::vector<SamplePoint> points;
    const int side = static_cast<int>(std::lround(std::sqrt(count)));
    const bool square = side * side == count;
    constexpr double k_phi2 = 1.32471795724474602596, k_phi4 = 1.16730397826141868426;
    for (int i = 0; i < count; ++i) {
        SamplePoint p{};
        if (square) {
            p.x = (i % side + 0.5) / side;
            p.y = (i / side + 0.5) / side;
        } else {
            p.x = std::fmod(0.5 + (i + 1) / k_phi2, 1.0);
            p.y = std::fmod(0.5 + (i + 1) / (k_phi2 * k_phi2), 1.0);
        }
        if (pupil) {
            const double u = std::fmod(0.5 + (i + 1) / k_phi4, 1.0);
            const double v = std::fmod(0.5 + (i + 1) / (k_phi4 * k_phi4), 1.0);
            const double radius = std::sqrt(u), angle = 2 * std::numbers::pi * v;
            p.pupil_x = radius * std::cos(angle);
            p.pupil_y = radius * std::sin(angle);
        }
        points.push_back(p);
    }
    return points;
}

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

struct PixelSums {
    double hit = 0;        // share of samples that meet the stone
    double luminance = 0;  // that they bring, as a share of the pixel
    double remainder = 0, absorbed = 0, cut = 0;
    double worst_imbalance = 0;
    long long rays = 0, sampled = 0;
};

double luminance(const Rgb& rgb) {
    return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
}

class PixelShader {
public:
    PixelShader(const Scene& scene, const Plan& plan, const LightField& lights,
                const WavelengthSet& colours, const PathLimits& limits, int samples)
        : body_(scene.stone.solid),
          eyes_(scene.camera),
          plan_(plan),
          lights_(lights),
          colours_(colours),
          limits_(limits),
          pattern_(sample_pattern(samples, plan.on(Effects::aperture))) {}

    // Mean radiance at every node over the pixel whose corner is (x, y), of side `size`.
    PixelSums shade(double x, double y, double size, std::uint64_t pixel, double* radiance) const {
        const int nodes = static_cast<int>(plan_.wavelengths_nm.size());
        std::fill(radiance, radiance + nodes, 0.0);
        std::vector<double> background(static_cast<std::size_t>(nodes), 0.0);
        PixelSums sums;
        const double share = 1.0 / static_cast<double>(pattern_.size());
        for (std::size_t i = 0; i < pattern_.size(); ++i) {
            const SamplePoint& p = pattern_[i];
            const EyeRay ray = eyes_.through(x + size * p.x, y + size * p.y, p.pupil_x, p.pupil_y);
            const auto entry = body_.entry(ray.origin, ray.direction);
            if (!entry) {
                lights_.add_radiance(ray.origin, ray.direction, 1.0, 0, nodes, background.data());
                continue;
            }
            sums.hit += share;
            for (const Band& band : plan_.bands) {
                Gather gather(lights_, band, radiance);
                PathLimits limits = limits_;
                limits.seed = limits_.seed +
                              0x9e3779b97f4a7c15ull * (pixel * pattern_.size() + i + 1) +
                              static_cast<std::uint64_t>(band.first);
                LightPaths<Gather> paths(body_, band, limits, gather);
                paths.trace(ray, *entry);
                sums.worst_imbalance = std::max(sums.worst_imbalance, paths.worst_imbalance());
                sums.sampled += paths.sampled();
                sums.remainder += share * gather.remainder_ / nodes;
                sums.absorbed += share * gather.absorbed_ / nodes;
                sums.cut += share * gather.cut_ / nodes;
                ++sums.rays;
            }
        }
        sums.luminance = share * luminance(colours_.rgb_of(radiance));
        for (int i = 0; i < nodes; ++i) radiance[i] = share * (radiance[i] + background[i]);
        return sums;
    }

private:
    ConvexBody body_;
    EyeRays eyes_;
    const Plan& plan_;
    const LightField& lights_;
    const WavelengthSet& colours_;
    PathLimits limits_;
    std::vector<SamplePoint> pattern_;
};

// Mean luminance of the stone at low resolution: what a tolerance is relative to.
double pilot_mean(const Scene& scene, const Plan& plan, const LightField& lights,
                  const WavelengthSet& colours, PathLimits limits) {
    limits.depth = 16;
    limits.cut_weight = 1e-3;
    limits.split_weight = 1;
    const PixelShader shader(scene, plan, lights, colours, limits, 1);
    const int longer = std::max(scene.camera.width, scene.camera.height);
    const double step = std::max(1.0, static_cast<double>(longer) / k_pilot_pixels);
    std::vector<double> radiance(plan.wavelengths_nm.size());
    double sum = 0, hits = 0;
    for (double y = 0; y < scene.camera.height; y += step) {
        for (double x = 0; x < scene.camera.width; x += step) {
            const PixelSums pixel = shader.shade(x, y, step, 0, radiance.data());
            hits += pixel.hit;
            sum += pixel.luminance;
        }
    }
    return hits > 0 ? sum / hits : 0;
}

}  // namespace

RenderResult render(const Scene& scene, const Progress& progress) {
    const auto start = std::chrono::steady_clock::now();
    require_renderable(scene);
    const Plan plan = make_plan(scene);
    const WavelengthSet colours(plan.wavelengths_nm);
    const LightField lights(scene.lights, colours);
    const Camera& camera = scene.camera;
    const RenderSettings& settings = scene.settings;

    PathLimits limits;
    limits.seed = settings.seed;
    limits.polarised = plan.polarised;
    limits.depth = settings.depth > 0 ? settings.depth : k_deepest;
    if (settings.tolerance > 0) {
        const double mean = pilot_mean(scene, plan, lights, colours, limits);
        const double brightest = lights.max_radiance();
        // What is cut sees at most the brightest light. Half of what that allows, because the
        // pilot's mean is itself a few per cent off.
        limits.cut_weight = brightest > 0 && mean > 0 ? 0.5 * settings.tolerance * mean / brightest
                                                      : settings.tolerance;
        limits.cut_weight = std::min(limits.cut_weight, settings.tolerance);
        limits.split_weight = std::max(k_split_weight, limits.cut_weight);
    }

    RenderResult result;
    Picture& picture = result.picture;
    picture.width = camera.width;
    picture.height = camera.height;
    picture.rgb.resize(3 * picture.pixels());
    picture.coverage.resize(picture.pixels());
    const int nodes = colours.size();
    if (settings.spectral) {
        picture.wavelengths_nm = plan.wavelengths_nm;
        picture.spectral.assign(nodes, std::vector<float>(picture.pixels()));
    }
    const PixelShader shader(scene, plan, lights, colours, limits, settings.samples);
    std::vector<PixelSums> sums(picture.pixels());
    result.stats.seconds_setup = seconds_since(start);

    const auto shading = std::chrono::steady_clock::now();
    const long long tiles_wide = (camera.width + k_tile - 1) / k_tile;
    const long long tiles_high = (camera.height + k_tile - 1) / k_tile;
    std::atomic<bool> stop{false};
    std::mutex reporting;
    long long done = 0;
    const auto shade_tile = [&](long long tile) {
        if (stop.load(std::memory_order_relaxed)) return;
        std::vector<double> radiance(nodes);
        const int x0 = static_cast<int>(tile % tiles_wide) * k_tile,
                  y0 = static_cast<int>(tile / tiles_wide) * k_tile;
        for (int y = y0; y < std::min(y0 + k_tile, camera.height); ++y) {
            for (int x = x0; x < std::min(x0 + k_tile, camera.width); ++x) {
                const std::size_t pixel =
                    static_cast<std::size_t>(y) * static_cast<std::size_t>(camera.width) +
                    static_cast<std::size_t>(x);
                sums[pixel] = shader.shade(x, y, 1.0, pixel, radiance.data());
                const Rgb rgb = colours.rgb_of(radiance.data());
                for (int c = 0; c < 3; ++c) picture.rgb[3 * pixel + c] = static_cast<float>(rgb[c]);
                picture.coverage[pixel] = static_cast<float>(sums[pixel].hit);
                if (settings.spectral) {
                    for (int i = 0; i < nodes; ++i)
                        picture.spectral[i][pixel] = static_cast<float>(radiance[i]);
                }
            }
        }
        const std::lock_guard<std::mutex> lock(reporting);
        ++done;
        if (progress &&
            !progress(static_cast<double>(done) / static_cast<double>(tiles_wide * tiles_high))) {
            stop.store(true, std::memory_order_relaxed);
        }
    };
    // More threads than processors are allowed when asked for, and without TBB's warning on stderr.
    const int most = static_cast<int>(
        tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
    const tbb::global_control allow(
        tbb::global_control::max_allowed_parallelism,
        static_cast<std::size_t>(std::max({most, settings.threads, 1})));
    tbb::task_arena arena(settings.threads > 0 ? settings.threads : tbb::task_arena::automatic);
    arena.execute([&] {
        tbb::parallel_for(0LL, tiles_wide * tiles_high, shade_tile, tbb::simple_partitioner());
    });
    if (stop.load()) throw Interrupted();

    // Sums in the order of the pixels: the same bytes whatever the threads did.
    RenderStats& stats = result.stats;
    double weight = 0, seen = 0;
    long long sampled = 0;
    for (std::size_t i = 0; i < sums.size(); ++i) {
        weight += sums[i].hit;
        stats.remainder += sums[i].remainder;
        stats.cut += sums[i].cut;
        stats.absorbed += sums[i].absorbed;
        stats.rays += sums[i].rays;
        sampled += sums[i].sampled;
        stats.worst_imbalance = std::max(stats.worst_imbalance, sums[i].worst_imbalance);
        seen += sums[i].luminance;
    }
    if (weight > 0) {
        stats.remainder /= weight;
        stats.cut /= weight;
        stats.absorbed /= weight;
        stats.mean_radiance = seen / weight;
    }
    if (stats.mean_radiance > 0) {
        stats.error_bound =
            (stats.remainder + stats.cut) * lights.max_radiance() / stats.mean_radiance;
    }
    stats.notes = notes_on_drawing(scene);
    if (sampled > 0) {
        stats.notes.push_back(
            fmt::format("the trees of {} of {} rays grew over {} splits: from there on one wave "
                        "was followed, chosen by power",
                        sampled, stats.rays, limits.most_splits));
    }
    if (settings.tolerance > 0 && stats.error_bound > settings.tolerance) {
        stats.notes.push_back(fmt::format("the error bound {:.3g} is over the tolerance {:.3g}",
                                          stats.error_bound, settings.tolerance));
    }
    stats.depth = limits.depth;
    stats.effects.assign(plan.effects.begin(), plan.effects.end());
    stats.wavelengths_nm = plan.wavelengths_nm;
    stats.seconds_shade = seconds_since(shading);
    return result;
}

std::string stats_json(const RenderStats& stats) {
    using Json = nlohmann::ordered_json;
    Json effects = Json::array();
    for (const EffectDecision& decision : stats.effects) {
        Json bound = decision.error_bound;
        if (std::isnan(decision.error_bound)) bound = nullptr;
        effects.push_back({{"name", name_of(decision.effect)},
                           {"on", decision.on},
                           {"why", decision.why},
                           {"error_bound", bound}});
    }
    const Json json = {{"schema", 1},
                       {"engine", stats.engine},
                       {"depth", stats.depth},
                       {"effects", effects},
                       {"wavelengths", stats.wavelengths_nm},
                       {"error_bound", stats.error_bound},
                       {"remainder", stats.remainder},
                       {"cut", stats.cut},
                       {"absorbed", stats.absorbed},
                       {"mean_radiance", stats.mean_radiance},
                       {"seconds",
                        {{"setup", stats.seconds_setup},
                         {"build", 0.0},
                         {"shade", stats.seconds_shade},
                         {"total", stats.seconds_setup + stats.seconds_shade}}},
                       {"worst_imbalance", stats.worst_imbalance},
                       {"notes", stats.notes},
                       {"beams", 0},
                       {"rays", stats.rays}};
    return json.dump(2) + "\n";
}

}  // namespace culet
