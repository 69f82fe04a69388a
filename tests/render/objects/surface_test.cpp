// What surfaces of objects do to light, and importance sampling of lights.

#include "render/objects/surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "render/objects/light_sampler.h"
#include "render/objects/rough_surface.h"
#include "render/optics/fresnel.h"

namespace culet {
namespace {

const WavelengthSet k_one({589.3});

ReadySurface metal(double n, double k, double roughness = 0) {
    return ReadySurface(MetalMaterial{{n}, {k}, {}, roughness}, k_one, 1);
}

ReadySurface metal_of(double f0, double roughness) {
    return ReadySurface(MetalMaterial{{1.0}, {0.0}, SurfaceColour{f0}, roughness}, k_one, 1);
}

// Born & Wolf, 14.2: ((n - 1)^2 + k^2) / ((n + 1)^2 + k^2) at normal incidence.
TEST(Metals, ReflectAtNormalIncidenceWhatTheirIndexSays) {
    for (const auto& [n, k] : {std::pair(0.055, 3.32), {1.2, 7.26}, {2.87, 3.36}, {1.5, 0.0}}) {
        const MuellerReflection r = metal(n, k).reflection(0, 1);
        const double wanted = ((n - 1) * (n - 1) + k * k) / ((n + 1) * (n + 1) + k * k);
        EXPECT_NEAR(r.mean, wanted, 1e-15);
        EXPECT_NEAR(r.difference, 0, 1e-15);
        // A mirror image: the frames of s and p have opposite handedness.
        EXPECT_NEAR(r.re, -wanted, 1e-15);
        EXPECT_NEAR(r.im, 0, 1e-15);
    }
    for (const double f0 : {0.0, 0.04, 0.5, 0.95, 1.0})
        EXPECT_NEAR(metal_of(f0, 0).reflection(0, 1).mean, f0, 1e-15);
}

// Without phases: the same in real numbers.
TEST(Metals, ReflectTheMeanOfSAndP) {
    for (const auto& [n, k] : {std::pair(0.055, 3.32), {1.2, 7.26}, {2.87, 3.36}, {1.5, 0.0}}) {
        const ReadySurface surface = metal(n, k);
        for (double cosine = 0; cosine <= 1; cosine += 0.01) {
            EXPECT_NEAR(surface.reflectance(0, cosine), surface.reflection(0, cosine).mean, 1e-13);
        }
    }
}

// Without extinction a metal is glass: the same numbers as fresnel.h, which has its own tests.
TEST(Metals, WithoutExtinctionAreGlass) {
    for (const double n : {1.2, 1.5, 2.4}) {
        const ReadySurface surface = metal(n, 0);
        for (double cosine = 0.02; cosine < 1; cosine += 0.02) {
            const FaceAmplitudes face = fresnel(1, n, cosine);
            const double s = std::norm(face.r_s), p = std::norm(face.r_p);
            const MuellerReflection r = surface.reflection(0, cosine);
            EXPECT_NEAR(r.mean, 0.5 * (s + p), 1e-14);
            EXPECT_NEAR(r.difference, 0.5 * (s - p), 1e-14);
            EXPECT_NEAR(r.re, (face.r_s * std::conj(face.r_p)).real(), 1e-14);
            EXPECT_NEAR(r.im, 0, 1e-14);
        }
    }
}

// Abeles' relation (1950): at 45 degrees R_p = R_s^2, whatever the index.
TEST(Metals, KeepAbelesRelationAt45Degrees) {
    for (const auto& [n, k] : {std::pair(0.055, 3.32), {1.2, 7.26}, {2.87, 3.36}}) {
        const MuellerReflection r = metal(n, k).reflection(0, std::sqrt(0.5));
        const double s = r.mean + r.difference, p = r.mean - r.difference;
        EXPECT_NEAR(p, s * s, 1e-14);
    }
}

// By definition, the projected area of the visible microfacets equals that of the surface: integral
// of D G1 max(0, m.v) dm = v.z (Heitz 2014, eq. 15). The weight of a sampled direction is the share
// of its light that leaves unshadowed, G2 / G1.
TEST(Microfacets, FillWhatIsSeenOfThem) {
    constexpr int k_heights = 20000, k_azimuths = 200;
    for (const double alpha : {0.1, 0.3, 0.8}) {
        for (const double cosine : {0.2, 0.6, 0.95}) {
            const Vec3 from{std::sqrt(1 - cosine * cosine), 0, cosine};
            double seen = 0;
            for (int i = 0; i < k_heights; ++i) {
                const double z = (i + 0.5) / k_heights, r = std::sqrt(1 - z * z);
                for (int j = 0; j < k_azimuths; ++j) {
                    const double azimuth = 2 * std::numbers::pi * (j + 0.5) / k_azimuths;
                    const Vec3 half{r * std::cos(azimuth), r * std::sin(azimuth), z};
                    const double angle = 2 * std::numbers::pi / (1.0 * k_heights * k_azimuths);
                    const double along = std::max(0.0, glm::dot(half, from));
                    seen += ggx::density(alpha, half) * ggx::masking(alpha, from) * along * angle;
                }
            }
            // The midpoint rule has an error of (step / width)^2 / 24; microfacets are alpha^2 / 2
            // wide in height, and back-facing ones make kinks in azimuth.
            EXPECT_NEAR(seen, cosine, 1e-4);
            Random random(7);
            double weight = 0;
            constexpr int k_samples = 200000;
            for (int i = 0; i < k_samples; ++i) {
                const Vec3 to = ggx::sample(alpha, from, random.uniform(), random.uniform());
                if (to.z <= 0) continue;
                const Vec3 h = glm::normalize(from + to);
                // f cos / density = G2 / G1 for a surface that reflects all light.
                const double f = ggx::density(alpha, h) *
                                 ggx::masking_and_shadowing(alpha, from, to) / (4 * cosine);
                const double ratio = f / ggx::sample_density(alpha, from, to);
                const double wanted =
                    ggx::masking_and_shadowing(alpha, from, to) / ggx::masking(alpha, from);
                EXPECT_NEAR(ratio, wanted, 1e-9);
                weight += ratio / k_samples;
            }
            EXPECT_LT(weight, 1);
        }
    }
}

// Conservation: a rough metal that reflects all light shows an even light unchanged. The mean of n
// samples lies within 5 standard errors, the table of albedos within 1e-3.
TEST(Microfacets, LoseNothingBetweenThem) {
    Random random(3);
    for (const double roughness : {0.2, 0.5, 1.0}) {
        const ReadySurface surface = metal_of(1, roughness);
        for (const double cosine : {0.05, 0.3, 0.7, 1.0}) {
            const Vec3 towards{std::sqrt(1 - cosine * cosine), 0, cosine};
            const RoughSurface rough(surface, {0, 0, 1}, {0, 0, 1}, towards);
            double sum = 0, squares = 0;
            constexpr int k_samples = 100000;
            for (int i = 0; i < k_samples; ++i) {
                const auto to = rough.sample(random);
                if (!to) continue;
                const double share = rough.value(0, rough.spread(*to)) / rough.density(*to);
                sum += share;
                squares += share * share;
            }
            const double mean = sum / k_samples;
            const double error = std::sqrt((squares / k_samples - mean * mean) / k_samples);
            EXPECT_NEAR(mean, 1, 5 * error + 1e-3) << roughness << " " << cosine;
        }
    }
}

// Flatter than the rounding error of directions: polished, and never NaN.
TEST(Microfacets, OfNoSlopeAreAPolishedSurface) {
    for (const double roughness : {1e-200, 1e-80, 1e-9, 1e-4}) {
        const ReadySurface surface = metal_of(0.9, roughness);
        EXPECT_EQ(surface.kind, SurfaceKind::metal) << roughness;
        EXPECT_NEAR(surface.reflectance(0, 1), 0.9, 1e-15);
    }
    const ReadySurface finest = metal_of(1, 1e-3 * 1.2);
    ASSERT_EQ(finest.kind, SurfaceKind::rough_metal);
    Random random(1);
    for (const double cosine : {0.01, 0.5, 1.0}) {
        const RoughSurface rough(finest, {0, 0, 1}, {0, 0, 1},
                                 {std::sqrt(1 - cosine * cosine), 0, cosine});
        for (int i = 0; i < 1000; ++i) {
            const auto to = rough.sample(random);
            if (!to) continue;
            const double share = rough.value(0, rough.spread(*to)) / rough.density(*to);
            EXPECT_NEAR(share, 1, 1e-2);
        }
    }
}

// Reciprocity: 4 cos cos f is symmetric, without the energy compensation (Turquin's gain depends on
// one direction alone).
TEST(Microfacets, ReflectBothWaysAlike) {
    const ReadySurface surface = metal(1.2, 7.26, 0.5);
    const Vec3 a = glm::normalize(Vec3{0.3, -0.5, 0.7}), b = glm::normalize(Vec3{-0.8, 0.1, 0.4});
    const RoughSurface from_a(surface, {0, 0, 1}, {0, 0, 1}, a),
        from_b(surface, {0, 0, 1}, {0, 0, 1}, b);
    const auto once = [&](const RoughSurface& rough, const Vec3& from, const Vec3& to) {
        return rough.value(0, rough.spread(to)) / to.z /
               surface.gain(0, surface.reflected_once(from.z));
    };
    EXPECT_NEAR(once(from_a, a, b), once(from_b, b, a), 1e-14);
}

Scene lit_by(Light light) {
    Scene scene;
    scene.camera.look_at = {0, 0, 0};
    scene.lights.sources = {std::move(light)};
    return scene;
}

// Densities integrate to one over all directions, and samples follow them: the mean of 1 / density
// over samples is the light's solid angle.
void expect_sampled(const Scene& scene, double solid_angle) {
    const LightSampler sampler(scene);
    ASSERT_FALSE(sampler.empty());
    const Vec3 from{0.1, 0.2, -0.3};
    Random random(5);
    double sum = 0, squares = 0;
    constexpr int k_samples = 20000;
    for (int i = 0; i < k_samples; ++i) {
        const auto direction = sampler.sample(from, random);
        ASSERT_TRUE(direction);
        EXPECT_NEAR(glm::length(*direction), 1, 1e-12);
        const double density = sampler.density(from, *direction);
        ASSERT_GT(density, 0);
        sum += 1 / density;
        squares += 1 / (density * density);
    }
    const double mean = sum / k_samples;
    const double error = std::sqrt(std::max(0.0, squares / k_samples - mean * mean) / k_samples);
    EXPECT_NEAR(mean, solid_angle, 5 * error + 1e-6 * solid_angle);
}

TEST(LightSampler, AimsAtSpheresRingsAndPanels) {
    const Vec3 from{0.1, 0.2, -0.3}, center{2, -1, 3};
    const double radius = 0.7, distance = glm::length(center - from);
    expect_sampled(
        lit_by(SphereLight{center, radius, {}}),
        2 * std::numbers::pi * (1 - std::sqrt(1 - radius * radius / (distance * distance))));
    expect_sampled(lit_by(DiscLight{{0, 0, 1}, 0.2, 0.5, {}}),
                   2 * std::numbers::pi * (std::cos(0.2) - std::cos(0.5)));
    // A rectangle seen from below its middle: 4 asin(a b / sqrt((a^2 + h^2) (b^2 + h^2))).
    const double a = 1.5, b = 0.5, h = 2;
    expect_sampled(
        lit_by(PlaneLight{from + Vec3{0, 0, h}, {0, 0, -1}, Vec3{a, 0, 0}, Vec3{0, b, 0}, {}}),
        4 * std::asin(a * b / std::sqrt((a * a + h * h) * (b * b + h * h))));
}

TEST(LightSampler, AimsAtEmitters) {
    Scene scene;
    const Vec3 from{0.1, 0.2, -0.3};
    scene.objects = {{DiscShape{from + Vec3{0, 0, 2}, {0, 0, 1}, 1.0}, EmitterMaterial{}}};
    // A disc seen along its axis: 2 pi (1 - cos).
    expect_sampled(scene, 2 * std::numbers::pi * (1 - 2 / std::sqrt(5.0)));
}

// A sky with one bright place: samples go there. The density integrates to one over the sphere.
TEST(LightSampler, AimsAtWhatIsBrightInAnEnvironment) {
    auto map = std::make_shared<EnvironmentMap>();
    map->width = 64;
    map->height = 32;
    map->rgb.assign(3 * 64 * 32, 0.1f);
    for (int c = 0; c < 3; ++c) map->rgb[static_cast<std::size_t>(3 * (5 * 64 + 17) + c)] = 500;
    Scene scene;
    scene.lights.environment = map;
    const LightSampler sampler(scene);
    double sum = 0;
    constexpr int k_steps = 400;
    for (int i = 0; i < k_steps; ++i) {
        for (int j = 0; j < 2 * k_steps; ++j) {
            const double z = 1 - 2 * (i + 0.5) / k_steps,
                         azimuth = std::numbers::pi * (j + 0.5) / k_steps;
            const double r = std::sqrt(1 - z * z);
            sum += sampler.density({}, {r * std::cos(azimuth), r * std::sin(azimuth), z}) * 4 *
                   std::numbers::pi / (2.0 * k_steps * k_steps);
        }
    }
    EXPECT_NEAR(sum, 1, 0.05);  // cells of the sum straddle the bright one
    Random random(1);
    int bright = 0;
    for (int i = 0; i < 1000; ++i) {
        const auto direction = sampler.sample({}, random);
        ASSERT_TRUE(direction);
        bright += map->at(*direction)[0] > 1;
    }
    EXPECT_GT(bright, 600);
}

}  // namespace
}  // namespace culet
