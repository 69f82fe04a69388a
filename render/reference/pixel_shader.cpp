#include "render/reference/pixel_shader.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>
#include <utility>

#include "render/optics/eye_optics.h"
#include "render/reference/crystal_paths.h"
#include "render/reference/gather.h"
#include "render/reference/light_paths.h"
#include "render/setup/built_effects.h"

namespace culet {

namespace {

constexpr int k_rays_of_a_wavelength = 4;

// Colour of each Stokes parameter (of 1) at each node, behind the eye's optics.
std::vector<Rgb> colour_weights(const WavelengthSet& colours, const EyeOptics& optics, int planes) {
    const int nodes = colours.size();
    std::vector<Rgb> weights(static_cast<std::size_t>(planes * nodes));
    std::vector<double> one(nodes, 0.0);
    for (int i = 0; i < nodes; ++i) {
        one[i] = 1;
        const Rgb of_node = colours.rgb_of(one.data());
        one[i] = 0;
        const Stokes row = response(optics, colours.wavelengths_nm()[i]);
        for (int k = 0; k < planes; ++k) {
            for (int c = 0; c < 3; ++c) weights[k * nodes + i][c] = of_node[c] * row[k];
        }
    }
    return weights;
}

// Mean over directions evenly spread on the sphere (Fibonacci spiral).
std::vector<double> usual_radiance(const Surroundings& surroundings, const Vec3& at, int nodes) {
    constexpr int k_directions = 256;
    constexpr double k_golden_angle = 2.39996322972865332;
    std::vector<double> mean(nodes, 0.0);
    for (int i = 0; i < k_directions; ++i) {
        const double z = 1 - (2 * i + 1.0) / k_directions, r = std::sqrt(1 - z * z);
        const Vec3 direction{r * std::cos(k_golden_angle * i), r * std::sin(k_golden_angle * i), z};
        surroundings.add_radiance(at, direction, 1.0 / k_directions, 0, nodes, mean.data());
    }
    return mean;
}

}  // namespace

PixelSums& PixelSums::operator+=(const PixelSums& more) {
    hit += more.hit;
    counted += more.counted;
    luminance += more.luminance;
    remainder += more.remainder;
    absorbed += more.absorbed;
    cut += more.cut;
    variance += more.variance;
    radiance += more.radiance;
    halves_apart += more.halves_apart;
    worst_imbalance = std::max(worst_imbalance, more.worst_imbalance);
    deepest = std::max(deepest, more.deepest);
    rays += more.rays;
    sampled += more.sampled;
    events += more.events;
    return *this;
}

PixelShader::PixelShader(const Scene& scene, const PreparedScene& prepared, int samples)
    : has_objects_(scene.has_objects()),
      has_stone_(scene.has_stone()),
      covers_objects_(has_objects_ && scene.film.alpha),
      body_(scene.stone.solid, scene.stone.convex),
      eyes_(scene.camera),
      setup_(prepared.setup),
      surroundings_(*prepared.surroundings),
      limits_(prepared.limits),
      pattern_(sample_pattern(samples, setup_.on(Effects::aperture), scene.settings.filter,
                              scene.settings.filter_radius)),
      share_(1.0 / static_cast<double>(pattern_.size())),
      nodes_(prepared.colours.size()),
      rgb_(colour_weights(prepared.colours, scene.camera.optics, planes())),
      usual_(usual_radiance(surroundings_, scene.camera.look_at, nodes_)) {
    limits_.obstacles = &surroundings_;
    limits_.alike = limits_.alike || body_.has_ground();
    for (const Rgb& rgb : rgb_) luminance_.push_back(luminance(rgb));
    // With objects, most of the noise is theirs, so a ray need not carry all wavelengths.
    const int usual_turns = has_objects_ ? std::max(1, samples / k_rays_of_a_wavelength) : 1;
    assign_bands_to_rays(
        std::clamp(scene.settings.wavelength_turns.value_or(usual_turns), 1,
                   static_cast<int>(std::min(pattern_.size(), setup_.bands.size()))));
}

void PixelShader::assign_bands_to_rays(int turns) {
    const std::size_t count = pattern_.size();
    // Order the grid's cells so that every stretch is evenly spread (Roberts 2018, R2).
    const std::size_t side = static_cast<std::size_t>(std::lround(std::sqrt(count)));
    const bool grid = side * side == count;
    std::vector<std::pair<double, std::size_t>> order;
    for (std::size_t i = 0; i < count; ++i) {
        const double x = static_cast<double>(i % side), y = static_cast<double>(i / side);
        order.emplace_back(grid ? std::fmod(0.7548776662466927 * x + 0.5698402909980532 * y, 1.0)
                                : std::fmod(0.6180339887498949 * static_cast<double>(i), 1.0),
                           i);
    }
    std::sort(order.begin(), order.end());
    // Two halves, to estimate the error of few rays: the black and white squares of a chessboard.
    // In each, every stretch of that order takes one turn.
    turns_ = turns;
    turn_.assign(count, 0);
    half_.assign(count, 0);
    std::array<std::vector<std::size_t>, 2> halves;
    for (const auto& [key, i] : order) {
        half_[i] = grid ? (i % side + i / side) % 2 : i % 2;
        halves[half_[i]].push_back(i);
    }
    std::vector<std::array<double, 2>> rays(static_cast<std::size_t>(turns));
    std::array<double, 2> in_half{};
    for (const std::vector<std::size_t>& of : halves) {
        for (std::size_t rank = 0; rank < of.size(); ++rank) {
            const std::size_t i = of[rank],
                              turn = rank * static_cast<std::size_t>(turns) / of.size();
            turn_[i] = static_cast<int>(turn);
            rays[turn][half_[i]] += 1;
            in_half[half_[i]] += 1;
        }
    }
    halved_ = std::all_of(rays.begin(), rays.end(),
                          [](const std::array<double, 2>& of) { return of[0] > 0 && of[1] > 0; });
    factor_.assign(luminance_.size(), 1.0);
    for (std::size_t half : {0, 1}) {
        of_half_[half].assign(luminance_.size(), 0.0);
        behind_half_[half] = in_half[half] > 0 ? 1 / in_half[half] : 0;
    }
    for (std::size_t b = 0; b < setup_.bands.size(); ++b) {
        const Band& band = setup_.bands[b];
        const std::array<double, 2>& of = rays[b % static_cast<std::size_t>(turns)];
        band_factor_.push_back(static_cast<double>(count) / (of[0] + of[1]));
        for (std::size_t first = 0; first < factor_.size(); first += nodes_) {
            for (int k = 0; k < band.count; ++k) {
                const std::size_t i = first + static_cast<std::size_t>(band.first + k);
                factor_[i] = band_factor_.back();
                for (std::size_t half : {0, 1}) of_half_[half][i] = of[half] > 0 ? 1 / of[half] : 0;
            }
        }
    }
    stone_luminance_ = luminance_;
    for (std::size_t i = 0; i < factor_.size(); ++i) stone_luminance_[i] *= factor_[i];
}

void PixelShader::background(const EyeRay& ray, double* stokes) const {
    if (!setup_.stokes) {
        surroundings_.add_radiance(ray.origin, ray.direction, 1.0, 0, nodes_, stokes);
        return;
    }
    surroundings_.add_direct_stokes(ray, eyes_.frame(ray.direction), nodes_, stokes);
}

void PixelShader::trace_band(const Band& band, const EyeRay& ray, const BodyHit& entry,
                             const PathLimits& limits, double part, double* seen, PixelSums& sums,
                             PixelMemory& memory) const {
    const auto take = [&](const UnseenWeights& unseen) {
        sums.remainder += part * unseen.remainder_ / nodes_;
        sums.absorbed += part * unseen.absorbed_ / nodes_;
        sums.cut += part * unseen.cut_ / nodes_;
        sums.deepest = std::max(sums.deepest, unseen.deepest_);
    };
    if (k_has_effects && setup_.general) {
        GatherStokes gather(surroundings_, band, stone_luminance_, usual_, nodes_, planes(), seen);
        CrystalPaths<GatherStokes> paths(body_, band, limits, gather);
        const EyeFrame frame = eyes_.frame(ray.direction);
        paths.trace(ray, frame.x, frame.y, entry);
        sums.worst_imbalance = std::max(sums.worst_imbalance, paths.worst_imbalance());
        sums.sampled += paths.sampled();
        sums.events += paths.events();
        sums.variance += share_ * share_ * gather.variance();
        take(gather);
        return;
    }
    const auto follow_in = [&](const auto& body, auto one) {
        Gather<one> gather(surroundings_, band, seen);
        LightPaths<Gather<one>, one, std::decay_t<decltype(body)>>(body, band, limits, gather,
                                                                   memory.trace)
            .trace(ray, entry);
        take(gather);
    };
    const auto follow = [&](auto one) {
        body_.convex() ? follow_in(body_.planes(), one) : follow_in(body_, one);
    };
    if (!k_has_effects || band.count == 1) {
        follow(std::true_type{});
    } else {
        follow(std::false_type{});
    }
    sums.events += memory.trace.length;
}

void PixelShader::trace_sample(std::size_t i, const EyeRay& ray, const BodyHit& entry,
                               std::uint64_t pixel, double* seen, PixelSums& sums,
                               PixelMemory& memory) const {
    for (std::size_t b = 0; b < (k_has_effects ? setup_.bands.size() : 1); ++b) {
        if (k_has_effects && static_cast<int>(b % static_cast<std::size_t>(turns_)) != turn_[i])
            continue;
        const Band& band = setup_.bands[b];
        PathLimits limits = limits_;
        limits.seed = limits_.seed + 0x9e3779b97f4a7c15ull * (pixel * pattern_.size() + i + 1) +
                      (limits_.alike ? 0 : static_cast<std::uint64_t>(band.first));
        trace_band(band, ray, entry, limits, share_ * band_factor_[b], seen, sums, memory);
        ++sums.rays;
    }
}

PixelSums PixelShader::shade(double x, double y, double size, std::uint64_t pixel, double* stokes,
                             PixelMemory& memory) const {
    const std::size_t values = static_cast<std::size_t>(planes() * nodes_);
    // Two halves of the rays: sums of what they see of the stone and beside it.
    memory.stone.assign(2 * values, 0.0);
    memory.behind.assign(2 * values, 0.0);
    PixelSums sums;
    for (std::size_t i = 0; i < pattern_.size(); ++i) {
        if (memory.goes_on && !memory.goes_on()) break;
        const SamplePoint& p = pattern_[i];
        if (!eyes_.sees(x + size * p.x, y + size * p.y)) continue;
        const EyeRay ray = eyes_.through(x + size * p.x, y + size * p.y, p.pupil_x, p.pupil_y);
        const auto entry = has_stone_ ? body_.entry(ray.origin, ray.direction, memory.entry)
                                      : std::optional<BodyHit>();
        if (!entry || surroundings_.nearest_distance(ray.origin, ray.direction) < entry->distance) {
            background(ray, memory.behind.data() + half_[i] * values);
            if (covers_objects_ && surroundings_.stands_at(ray.origin, ray.direction))
                sums.hit += share_;
            continue;
        }
        sums.hit += share_;
        if (!has_objects_) sums.counted += share_;
        trace_sample(i, ray, *entry, pixel, memory.stone.data() + half_[i] * values, sums, memory);
    }
    if (has_objects_) sums.counted = 1;
    add_up(memory, sums, stokes);
    return sums;
}

void PixelShader::add_up(const PixelMemory& memory, PixelSums& sums, double* stokes) const {
    const std::size_t values = static_cast<std::size_t>(planes() * nodes_);
    Rgb apart{};
    double luminance_apart = 0;
    for (std::size_t i = 0; i < values; ++i) {
        const double *stone = &memory.stone[i], *behind = &memory.behind[i];
        const double of_stone = factor_[i] * (stone[0] + stone[values]);
        const double whole = share_ * (of_stone + (behind[0] + behind[values]));
        const double difference = of_half_[0][i] * stone[0] - of_half_[1][i] * stone[values] +
                                  behind_half_[0] * behind[0] - behind_half_[1] * behind[values];
        sums.luminance += luminance_[i] * (has_objects_ ? whole : share_ * of_stone);
        luminance_apart += luminance_[i] * difference;
        for (std::size_t c = 0; c < 3; ++c) {
            apart[c] += rgb_[i][c] * difference;
            if (sums.counted > 0) sums.radiance += rgb_[i][c] * whole / 3;
        }
        stokes[i] = whole;
    }
    if (halved_ && sums.counted > 0)
        sums.halves_apart = (std::abs(apart[0]) + std::abs(apart[1]) + std::abs(apart[2])) / 6;
    // With objects every ray is random: the mean of two independent halves has a quarter of their
    // difference's variance, edges within the pixel included.
    if (has_objects_ && halved_) sums.variance = 0.25 * luminance_apart * luminance_apart;
}

}  // namespace culet
