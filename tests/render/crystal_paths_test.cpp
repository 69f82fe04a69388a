// Expectations: conservation (leaves + remainder + absorbed + cut = 1) in every optical class, the
// special case of light_paths.h, closed forms of plates between polarisers, and reciprocity.

#include "render/crystal_paths.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "render/eye_optics.h"
#include "render/light_paths.h"
#include "tests/render/ray_stones.h"

namespace {

using namespace culet;

struct Sums {
    double leaves = 0, left = 0, lost = 0, dropped = 0;
    std::vector<double> leaf_weights;
    std::vector<PathEnd> ends;
    std::vector<std::string> modes;
    void leaf(const PathEnd& end, const PathTrace& trace) {
        const double weight = end.coherency.power() * end.transmitted[0];
        leaves += weight;
        leaf_weights.push_back(weight);
        ends.push_back(end);
        modes.emplace_back(trace.modes.begin(), trace.modes.begin() + trace.length - 1);
    }
    void leaf(const Vec3&, const Vec3&, const NodeWeights& w, const PathTrace&) {
        leaves += w[0];
        leaf_weights.push_back(w[0]);
    }
    void remainder(const NodeWeights& w) { left += w[0]; }
    void absorbed(const NodeWeights& w) { lost += w[0]; }
    void cut(const NodeWeights& w) { dropped += w[0]; }
    void gambled(const NodeWeights& w) { dropped += w[0]; }
    void choice_begins() {}
    void choice_ends(bool) {}
    double total() const { return leaves + left + lost + dropped; }
};

std::array<Vec3, 3> random_axes(std::mt19937_64& random) {
    const Vec3 a = random_direction(random);
    const Vec3 b = glm::normalize(glm::cross(a, random_direction(random)));
    return {a, b, glm::cross(a, b)};
}

Sums traced(const StoneBody& body, const Band& band, const PathLimits& limits, const EyeRay& ray,
            const Vec3& right = {1, 0, 0}) {
    Sums sums;
    const auto entry = body.entry(ray.origin, ray.direction);
    if (!entry) return sums;
    const Vec3 y = glm::normalize(glm::cross(right, ray.direction));
    CrystalPaths<Sums>(body, band, limits, sums)
        .trace(ray, glm::cross(ray.direction, y), y, *entry);
    return sums;
}

TEST(CrystalPaths, white_furnace_balances_in_every_optical_class) {
    const unsigned seed = 2026;
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> index(1.01, 4), split(0, 0.3);
    double worst = 0;
    int rays = 0;
    for (int stone = 0; stone < 40; ++stone) {
        const StoneBody body(random_stone(random, 20), true);
        Band band;
        const double n = index(random);
        // Isotropic, uniaxial, biaxial, and so nearly isotropic that the waves are one.
        const std::array<std::array<double, 3>, 4> classes{
            {{n, n, n},
             {n + split(random), n, n},
             {n, n + 0.5 * split(random), n + 0.3},
             {n, n + 1e-9, n + 1e-7 * split(random)}}};
        band.crystal = Crystal(
            stone % 5 == 0 ? std::array<Vec3, 3>{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}
                           : random_axes(random),
            classes[stone % 4]);
        band.n_outside = stone % 7 == 3 ? 1.5 : 1;
        band.coherence_length = stone % 3 == 0 ? 0 : stone % 3 == 1 ? 0.015 : 1e300;
        if (stone % 2 == 0) {
            band.absorbs = true;
            for (int axis = 0; axis < 3; ++axis)
                band.absorption[axis][0] = band.crystal.isotropic() ? 0.4 : 0.3 * axis + 0.1;
        }
        for (int i = 0; i < 12; ++i) {
            const EyeRay ray = random_ray(random);
            for (const int depth : {1, 2, 5, 9}) {
                for (const double cut : {0.0, 1e-3}) {
                    PathLimits limits;
                    limits.depth = depth;
                    limits.cut_weight = cut;
                    limits.split_weight = cut > 0 ? 0.05 : 0;
                    limits.roulette = cut > 0 && i % 2 == 0;
                    const Sums sums = traced(body, band, limits, ray);
                    if (sums.ends.empty()) continue;
                    ++rays;
                    worst = std::max(worst, std::abs(sums.total() - 1));
                }
            }
        }
    }
    EXPECT_GT(rays, 1000);
    EXPECT_LT(worst, 1e-12) << "seed " << seed;
}

TEST(CrystalPaths, isotropic_stones_give_what_light_paths_give) {
    // Two tracers with nothing in common but Maxwell: Fresnel's formulas on fields in global
    // coordinates, and the crystal's modes with their boundary system.
    const unsigned seed = 3;
    std::mt19937_64 random(seed);
    double worst = 0;
    int leaves = 0;
    for (int stone = 0; stone < 20; ++stone) {
        const Solid solid = random_stone(random, 25);
        const StoneBody body(solid, true);
        Band band;
        band.n = 1.1 + 0.1 * stone;
        band.crystal = uniaxial_crystal(random_direction(random), band.n, band.n);
        band.absorbs = stone % 2 == 1;
        for (auto& axis : band.absorption) axis[0] = 0.2;
        PathLimits limits;
        limits.depth = 12;
        for (int i = 0; i < 20; ++i) {
            const EyeRay ray = random_ray(random);
            const Sums general = traced(body, band, limits, ray);
            if (general.ends.empty()) continue;
            Sums special;
            LightPaths<Sums>(body.planes(), band, limits, special)
                .trace(ray, *body.entry(ray.origin, ray.direction));
            ASSERT_EQ(general.leaf_weights.size(), special.leaf_weights.size());
            for (std::size_t l = 0; l < special.leaf_weights.size(); ++l, ++leaves) {
                worst =
                    std::max(worst, std::abs(general.leaf_weights[l] - special.leaf_weights[l]));
            }
        }
    }
    EXPECT_GT(leaves, 1000);
    EXPECT_LT(worst, 1e-12) << "seed " << seed;
}

// Radiance of the paths with `inner` segments, behind an analyser, of light polarised at an angle.
double between_polarisers(const Sums& sums, std::size_t inner, double polarizer, double analyzer) {
    EyeOptics optics;
    optics.analyzer = analyzer;
    const Stokes row = response(optics, 550);
    const LinearPolarisation light{{std::cos(polarizer), std::sin(polarizer), 0}, Vec3{0, 0, 1}, 1};
    double seen = 0;
    for (std::size_t i = 0; i < sums.ends.size(); ++i) {
        if (sums.modes[i].size() != inner || sums.ends[i].direction.z > 0) continue;
        const PathEnd& end = sums.ends[i];
        const Vec3 e = light.of_ray(end.direction);
        const Stokes stokes =
            stokes_of_linear(end.coherency, glm::dot(e, end.u), glm::dot(e, end.v));
        for (int k = 0; k < 4; ++k) seen += row[k] * stokes[k];
    }
    return seen;
}

TEST(CrystalPaths, plate_between_crossed_polarisers_follows_the_closed_form) {
    // I = T_o T_e-weighted sin^2(2 a) sin^2(pi G / lambda): for a plate whose axis lies in it at
    // angle a to the polariser, with amplitudes t_o, t_e through both faces,
    // I = sin^2(2a)/4 |t_o e^{i d_o} - t_e e^{i d_e}|^2 (Born & Wolf 15.4.1 with the faces' own
    // transmission). Light passes once: depth 2.
    const double thickness = 0.031, n_o = 1.544, n_e = 1.553;
    const StoneBody body(slab(thickness), true);
    const EyeRay ray{{0.3, 0.2, 5}, {0, 0, -1}};
    PathLimits limits;
    limits.depth = 2;
    const double t_o = 4 * n_o / ((1 + n_o) * (1 + n_o)), t_e = 4 * n_e / ((1 + n_e) * (1 + n_e));
    for (const double wavelength : {450e-6, 550e-6, 650e-6}) {
        for (int turn = 0; turn < 12; ++turn) {
            const double a = 0.26 * turn;
            Band band;
            band.crystal = uniaxial_crystal({std::cos(a), std::sin(a), 0}, n_o, n_e);
            band.wavelength = wavelength;
            band.coherence_length = std::numeric_limits<double>::infinity();
            const Sums sums = traced(body, band, limits, ray);
            const double delta = 2 * std::numbers::pi * (n_e - n_o) * thickness / wavelength;
            const double s = std::sin(2 * a);
            const double crossed =
                0.25 * s * s * (t_o * t_o + t_e * t_e - 2 * t_o * t_e * std::cos(delta));
            EXPECT_NEAR(between_polarisers(sums, 1, 0, std::numbers::pi / 2), crossed, 1e-12);
            // Parallel: |t_o sin^2 a + t_e cos^2 a e^{i d}|^2.
            const double so = std::pow(std::sin(a), 2), ce = std::pow(std::cos(a), 2);
            const double parallel = t_o * t_o * so * so + t_e * t_e * ce * ce +
                                    2 * t_o * t_e * so * ce * std::cos(delta);
            EXPECT_NEAR(between_polarisers(sums, 1, 0, 0), parallel, 1e-12);
        }
    }
}

TEST(CrystalPaths, partial_coherence_is_the_mean_over_the_band) {
    // The mean of the monochromatic result over a triangular band in 1/wavelength, which is what
    // the factor sinc^2 stands for. 400 steps of the midpoint rule leave some 1e-5.
    const double thickness = 0.4, n_o = 1.544, n_e = 1.553, wavelength = 550e-6;
    const double bandwidth = 40e-6;
    const StoneBody body(slab(thickness), true);
    const EyeRay ray{{0.3, 0.2, 5}, {0, 0, -1}};
    PathLimits limits;
    limits.depth = 2;
    Band band;
    band.crystal = uniaxial_crystal(glm::normalize(Vec3{1, 1, 0}), n_o, n_e);
    const auto crossed = [&] {
        return between_polarisers(traced(body, band, limits, ray), 1, 0, std::numbers::pi / 2);
    };
    band.wavelength = wavelength;
    band.coherence_length = wavelength * wavelength / bandwidth;
    const double partial = crossed();
    band.coherence_length = std::numeric_limits<double>::infinity();
    double mean = 0, weights = 0;
    const int steps = 400;
    for (int i = 0; i < steps; ++i) {
        const double x = (i + 0.5) / steps * 2 - 1;
        const double wavenumber = 1 / wavelength * (1 + x * bandwidth / wavelength);
        band.wavelength = 1 / wavenumber;
        mean += (1 - std::abs(x)) * crossed();
        weights += 1 - std::abs(x);
    }
    mean /= weights;
    const double pure = [&] {
        band.wavelength = wavelength;
        return crossed();
    }();
    EXPECT_NEAR(partial, mean, 1e-4);
    EXPECT_GT(std::abs(pure - mean), 0.05) << "the band matters here";
}

TEST(CrystalPaths, waves_far_apart_are_followed_apart) {
    const StoneBody body(slab(4), true);
    Band band;
    band.crystal = uniaxial_crystal(glm::normalize(Vec3{1, 1, 0.3}), 1.658, 1.486);
    band.coherence_length = 0.015;
    PathLimits limits;
    limits.depth = 3;
    const Sums sums =
        traced(body, band, limits, {{0.3, 0.2, 5}, glm::normalize(Vec3{0.1, 0.3, -1})});
    for (const std::string& modes : sums.modes) {
        for (char m : modes) EXPECT_NE(m, 'c') << modes;
    }
    // First face, two waves, four after the reflection.
    EXPECT_EQ(sums.modes.size(), 1u + 2u + 4u);
}

TEST(CrystalPaths, vanishing_birefringence_tends_to_the_isotropic_stone) {
    // Coherent: as n_e -> n_o every leaf becomes the isotropic one, to first order in n_e - n_o
    // times the path in wavelengths.
    const unsigned seed = 12;
    std::mt19937_64 random(seed);
    const Solid solid = random_stone(random, 25);
    const StoneBody body(solid, true);
    PathLimits limits;
    limits.depth = 8;
    for (const double split : {1e-9, 1e-12, 1e-14}) {
        for (int i = 0; i < 30; ++i) {
            Band band, isotropic;
            isotropic.crystal = uniaxial_crystal({0, 0, 1}, 1.7, 1.7);
            const auto axes = random_axes(random);
            band.crystal = i % 2 == 0 ? Crystal(axes, {1.7, 1.7 + split, 1.7 + 2 * split})
                                      : Crystal(axes, {1.7 + split, 1.7, 1.7});
            band.coherence_length = 1;
            const EyeRay ray = random_ray(random);
            const Sums weak = traced(body, band, limits, ray);
            const Sums none = traced(body, isotropic, limits, ray);
            ASSERT_EQ(weak.leaf_weights.size(), none.leaf_weights.size());
            // 8 segments of 3 units at a wavelength of 6e-4: 2.5e5 radians a unit of index.
            for (std::size_t l = 0; l < weak.leaf_weights.size(); ++l)
                EXPECT_NEAR(weak.leaf_weights[l], none.leaf_weights[l], 1e-12 + 1e6 * split)
                    << "seed " << seed;
        }
    }
}

}  // namespace
