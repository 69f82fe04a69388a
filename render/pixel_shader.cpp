#include "render/pixel_shader.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "render/crystal_paths.h"
#include "render/eye_optics.h"
#include "render/gather.h"
#include "render/light_paths.h"

namespace culet {

namespace {

class GatherStokes : public Lost {
public:
    GatherStokes(const LightField& lights, const Band& band, const std::vector<double>& luminance,
                 const std::vector<double>& usual, int nodes, int planes, double* stokes)
        : Lost(band.count),
          lights_(lights),
          band_(band),
          luminance_(luminance),
          usual_(usual),
          nodes_(nodes),
          planes_(planes),
          stokes_(stokes) {}

    void leaf(const PathEnd& end, const PathTrace& trace) {
        seen(trace);
        if (planes_ == 4) {
            lights_.add_stokes(end, band_.first, band_.count, stokes_, nodes_);
            return;
        }
        NodeWeights seen{};
        lights_.add_radiance(end.at, end.direction, end.coherency.power(), band_.first, band_.count,
                             seen.data());
        for (int i = 0; i < band_.count; ++i)
            stokes_[band_.first + i] += end.transmitted[i] * seen[i];
    }
    // Weight of mean 0, so it may be given any radiance: the usual one makes up best for what was
    // lost, and exactly in a constant light.
    void gambled(const NodeWeights& weight) {
        for (int i = 0; i < band_.count; ++i)
            stokes_[band_.first + i] += weight[i] * usual_[band_.first + i];
    }
    void choice_begins() { estimates_.begin(luminance_so_far()); }
    void choice_ends(bool second) { estimates_.end(second, luminance_so_far()); }
    double variance() const { return estimates_.variance(); }

private:
    double luminance_so_far() const {
        double sum = 0;
        for (int k = 0; k < planes_; ++k) {
            for (int i = band_.first; i < band_.first + band_.count; ++i)
                sum += luminance_[k * nodes_ + i] * stokes_[k * nodes_ + i];
        }
        return sum;
    }
    const LightField& lights_;
    const Band& band_;
    const std::vector<double>&luminance_, &usual_;
    int nodes_, planes_;
    double* stokes_;
    PairedEstimates estimates_;
};

std::vector<double> luminance_weights(const WavelengthSet& colours, const EyeOptics& optics,
                                      int planes) {
    const int nodes = colours.size();
    std::vector<double> weights(static_cast<std::size_t>(planes * nodes)), one(nodes, 0.0);
    for (int i = 0; i < nodes; ++i) {
        one[i] = 1;
        const double of_node = luminance(colours.rgb_of(one.data()));
        one[i] = 0;
        const Stokes row = response(optics, colours.wavelengths_nm()[i]);
        for (int k = 0; k < planes; ++k) weights[k * nodes + i] = of_node * row[k];
    }
    return weights;
}

// Mean over directions evenly spread on the sphere (Fibonacci's spiral).
std::vector<double> usual_radiance(const LightField& lights, const Vec3& at, int nodes) {
    constexpr int k_directions = 256;
    constexpr double k_golden_angle = 2.39996322972865332;
    std::vector<double> mean(nodes, 0.0);
    for (int i = 0; i < k_directions; ++i) {
        const double z = 1 - (2 * i + 1.0) / k_directions, r = std::sqrt(1 - z * z);
        const Vec3 direction{r * std::cos(k_golden_angle * i), r * std::sin(k_golden_angle * i), z};
        lights.add_radiance(at, direction, 1.0 / k_directions, 0, nodes, mean.data());
    }
    return mean;
}

}  // namespace

PixelSums& PixelSums::operator+=(const PixelSums& more) {
    hit += more.hit;
    luminance += more.luminance;
    remainder += more.remainder;
    absorbed += more.absorbed;
    cut += more.cut;
    variance += more.variance;
    halves_apart += more.halves_apart;
    worst_imbalance = std::max(worst_imbalance, more.worst_imbalance);
    deepest = std::max(deepest, more.deepest);
    rays += more.rays;
    sampled += more.sampled;
    events += more.events;
    return *this;
}

PixelShader::PixelShader(const Scene& scene, const Plan& plan, const LightField& lights,
                         const WavelengthSet& colours, const PathLimits& limits, int samples)
    : body_(scene.stone.solid, scene.stone.convex),
      eyes_(scene.camera),
      plan_(plan),
      lights_(lights),
      limits_(limits),
      pattern_(sample_pattern(samples, plan.on(Effects::aperture), scene.settings.filter,
                              scene.settings.filter_radius)),
      nodes_(colours.size()),
      luminance_(luminance_weights(colours, scene.camera.optics, plan.stokes ? 4 : 1)),
      usual_(usual_radiance(lights, scene.camera.look_at, nodes_)) {
    // The black and the white squares of a chessboard, where samples are on a square grid.
    const std::size_t side = static_cast<std::size_t>(std::lround(std::sqrt(samples)));
    for (std::size_t i = 0; i < pattern_.size(); ++i) {
        half_.push_back(side * side == pattern_.size() ? (i % side + i / side) % 2 : i % 2);
        in_half_[half_.back()] += 1;
    }
}

void PixelShader::background(const EyeRay& ray, double* stokes) const {
    if (!plan_.stokes) {
        lights_.add_radiance(ray.origin, ray.direction, 1.0, 0, nodes_, stokes);
        return;
    }
    lights_.add_direct_stokes(ray, eyes_.frame(ray.direction), nodes_, stokes);
}

PixelSums PixelShader::shade(double x, double y, double size, std::uint64_t pixel, double* stokes,
                             PixelMemory& memory) const {
    const std::size_t values = static_cast<std::size_t>(planes() * nodes_);
    std::fill(stokes, stokes + values, 0.0);
    std::vector<double>& behind = memory.behind;
    behind.assign(values, 0.0);
    PixelSums sums;
    const double share = 1.0 / static_cast<double>(pattern_.size());
    const auto luminance_of = [&](const double* of) {
        double sum = 0;
        for (std::size_t i = 0; i < values; ++i) sum += luminance_[i] * of[i];
        return sum;
    };
    double so_far = 0;
    std::array<double, 2> halves{};
    for (std::size_t i = 0; i < pattern_.size(); ++i) {
        const SamplePoint& p = pattern_[i];
        if (!eyes_.sees(x + size * p.x, y + size * p.y)) continue;
        const EyeRay ray = eyes_.through(x + size * p.x, y + size * p.y, p.pupil_x, p.pupil_y);
        const auto entry = body_.entry(ray.origin, ray.direction, memory.entry);
        if (!entry || lights_.nearest_distance(ray.origin, ray.direction) < entry->distance) {
            background(ray, behind.data());
            const double now = luminance_of(stokes) + luminance_of(behind.data());
            halves[half_[i]] += now - so_far;
            so_far = now;
            continue;
        }
        sums.hit += share;
        for (const Band& band : plan_.bands) {
            PathLimits limits = limits_;
            limits.seed = limits_.seed + 0x9e3779b97f4a7c15ull * (pixel * pattern_.size() + i + 1) +
                          (limits_.alike ? 0 : static_cast<std::uint64_t>(band.first));
            const auto take = [&](const Lost& lost) {
                sums.remainder += share * lost.remainder_ / nodes_;
                sums.absorbed += share * lost.absorbed_ / nodes_;
                sums.cut += share * lost.cut_ / nodes_;
                sums.deepest = std::max(sums.deepest, lost.deepest_);
            };
            if (plan_.general) {
                GatherStokes gather(lights_, band, luminance_, usual_, nodes_, planes(), stokes);
                CrystalPaths<GatherStokes> paths(body_, band, limits, gather);
                const EyeFrame frame = eyes_.frame(ray.direction);
                paths.trace(ray, frame.x, frame.y, *entry);
                sums.worst_imbalance = std::max(sums.worst_imbalance, paths.worst_imbalance());
                sums.sampled += paths.sampled();
                sums.events += paths.events();
                sums.variance += share * share * gather.variance();
                take(gather);
            } else {
                Gather gather(lights_, band, stokes);
                LightPaths<Gather>(body_.planes(), band, limits, gather, memory.trace)
                    .trace(ray, *entry);
                sums.events += memory.trace.length;
                take(gather);
            }
            ++sums.rays;
        }
        const double now = luminance_of(stokes) + luminance_of(behind.data());
        halves[half_[i]] += now - so_far;
        so_far = now;
    }
    sums.luminance = share * luminance_of(stokes);
    if (pattern_.size() > 1 && sums.hit > 0) {
        sums.halves_apart = 0.5 * std::abs(halves[0] / in_half_[0] - halves[1] / in_half_[1]);
    }
    for (std::size_t i = 0; i < values; ++i) stokes[i] = share * (stokes[i] + behind[i]);
    return sums;
}

}  // namespace culet
