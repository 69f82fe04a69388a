// Expectations: energy balance (exits + remainder + absorbed + cut = 1) in every optical class, the
// special case of light_paths.h, closed forms of plates between polarisers, and reciprocity.

#include "render/reference/crystal_paths.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "render/optics/eye_optics.h"
#include "render/reference/light_paths.h"
#include "stone/solid/least_rotation.h"
#include "stone/solid/perpendicular.h"
#include "tests/render/ray_stones.h"

namespace {

using namespace culet;

struct PathSums {
    double leaves = 0, left = 0, lost = 0, dropped = 0;
    std::vector<double> exit_weights;
    std::vector<PathEnd> ends;
    std::vector<std::string> modes;
    void path_exits(const PathEnd& end, const PathTrace& trace) {
        const double weight = end.coherency.power() * end.transmitted[0];
        leaves += weight;
        exit_weights.push_back(weight);
        ends.push_back(end);
        modes.emplace_back(trace.modes.begin(), trace.modes.begin() + trace.length - 1);
    }
    void path_exits(const Vec3&, const Vec3&, const NodeWeights& w, const PathTrace&) {
        leaves += w[0];
        exit_weights.push_back(w[0]);
    }
    void remainder(const NodeWeights& w) { left += w[0]; }
    void absorbed(const NodeWeights& w) { lost += w[0]; }
    void cut(const NodeWeights& w) { dropped += w[0]; }
    void roulette(const NodeWeights& w) { dropped += w[0]; }
    void choice_begins() {}
    void choice_ends(bool) {}
    double total() const { return leaves + left + lost + dropped; }
};

std::array<Vec3, 3> random_axes(std::mt19937_64& random) {
    const Vec3 a = random_direction(random);
    const Vec3 b = glm::normalize(glm::cross(a, random_direction(random)));
    return {a, b, glm::cross(a, b)};
}

PathSums traced(const StoneBody& body, const Band& band, const PathLimits& limits,
                const EyeRay& ray, const Vec3& right = {1, 0, 0}) {
    PathSums sums;
    const auto entry = body.entry(ray.origin, ray.direction);
    if (!entry) return sums;
    const Vec3 y = glm::normalize(glm::cross(right, ray.direction));
    CrystalPaths<PathSums>(body, band, limits, sums)
        .trace(ray, glm::cross(ray.direction, y), y, *entry);
    return sums;
}

TEST(CrystalPaths, WhiteFurnaceBalancesInEveryOpticalClass) {
    const unsigned seed = 2026;
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> index(1.01, 4), split(0, 0.3);
    double worst = 0;
    int rays = 0;
    for (int stone = 0; stone < 40; ++stone) {
        const StoneBody body(random_stone(random, 20), true);
        Band band;
        const double n = index(random);
        // Isotropic, uniaxial, biaxial, and so nearly isotropic that the waves merge.
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
                    const PathSums sums = traced(body, band, limits, ray);
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

TEST(CrystalPaths, IsotropicStonesGiveWhatLightPathsGive) {
    // Two independent tracers, which share only Maxwell's equations: Fresnel's formulas on fields
    // in global coordinates, and the crystal's modes with their boundary system.
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
            const PathSums general = traced(body, band, limits, ray);
            if (general.ends.empty()) continue;
            PathSums special;
            LightPaths<PathSums>(body.planes(), band, limits, special)
                .trace(ray, *body.entry(ray.origin, ray.direction));
            ASSERT_EQ(general.exit_weights.size(), special.exit_weights.size());
            for (std::size_t l = 0; l < special.exit_weights.size(); ++l, ++leaves) {
                worst =
                    std::max(worst, std::abs(general.exit_weights[l] - special.exit_weights[l]));
            }
        }
    }
    EXPECT_GT(leaves, 1000);
    EXPECT_LT(worst, 1e-12) << "seed " << seed;
}

// The radiance behind an analyser of the paths with `inner` segments, in light polarised at an
// angle.
double between_polarisers(const PathSums& sums, std::size_t inner, double polarizer,
                          double analyzer) {
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

TEST(CrystalPaths, PlateBetweenCrossedPolarisersFollowsTheClosedForm) {
    // For a plate whose axis lies in it at angle a to the polariser, with amplitudes t_o, t_e
    // through both faces, crossed polarisers give I = sin^2(2a)/4 |t_o e^{i d_o} - t_e e^{i d_e}|^2
    // (Born & Wolf 15.4.1, with the faces' transmission). Light passes once: depth 2.
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
            const PathSums sums = traced(body, band, limits, ray);
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

TEST(CrystalPaths, PartialCoherenceIsTheMeanOverTheBand) {
    // The mean of the monochromatic result over a triangular band in 1/wavelength, which the factor
    // sinc^2 stands for. 400 steps of the midpoint rule leave an error of some 1e-5.
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

TEST(CrystalPaths, WavesFarApartAreFollowedApart) {
    const StoneBody body(slab(4), true);
    Band band;
    band.crystal = uniaxial_crystal(glm::normalize(Vec3{1, 1, 0.3}), 1.658, 1.486);
    band.coherence_length = 0.015;
    PathLimits limits;
    limits.depth = 3;
    const PathSums sums =
        traced(body, band, limits, {{0.3, 0.2, 5}, glm::normalize(Vec3{0.1, 0.3, -1})});
    for (const std::string& modes : sums.modes) {
        for (char m : modes) EXPECT_NE(m, 'c') << modes;
    }
    // First face, two waves, four after the reflection.
    EXPECT_EQ(sums.modes.size(), 1u + 2u + 4u);
}

TEST(CrystalPaths, VanishingBirefringenceTendsToTheIsotropicStone) {
    // Coherent: as n_e -> n_o every exit becomes the isotropic one, to first order in n_e - n_o
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
            const PathSums weak = traced(body, band, limits, ray);
            const PathSums none = traced(body, isotropic, limits, ray);
            ASSERT_EQ(weak.exit_weights.size(), none.exit_weights.size());
            // 8 segments of 3 units at a wavelength of 6e-4: 2.5e5 radians per unit of index.
            for (std::size_t l = 0; l < weak.exit_weights.size(); ++l)
                EXPECT_NEAR(weak.exit_weights[l], none.exit_weights[l], 1e-12 + 1e6 * split)
                    << "seed " << seed;
        }
    }
}

struct Ways {
    struct Way {
        std::vector<int> facets;
        std::string modes;
        double weight;
        Vec3 at, direction;
    };
    std::vector<Way> ways;
    void path_exits(const PathEnd& end, const PathTrace& trace) {
        ways.push_back({{trace.facets.begin(), trace.facets.begin() + trace.length},
                        {trace.modes.begin(), trace.modes.begin() + trace.length - 1},
                        end.coherency.power(),
                        end.at,
                        end.direction});
    }
    void remainder(const NodeWeights&) {}
    void absorbed(const NodeWeights&) {}
    void cut(const NodeWeights&) {}
    void roulette(const NodeWeights&) {}
    void choice_begins() {}
    void choice_ends(bool) {}
};

TEST(CrystalPaths, APathAndItsReverseWeighTheSame) {
    // Lorentz reciprocity: every exit, sent back along its path, meets the same facets and modes in
    // reverse order with the same weight.
    const unsigned seed = 77;
    std::mt19937_64 random(seed);
    PathLimits limits;
    limits.depth = 5;
    int compared = 0;
    double worst = 0;
    for (int stone = 0; stone < 12; ++stone) {
        const StoneBody body(random_stone(random, 14), true);
        Band band;
        const auto axes = random_axes(random);
        band.crystal = stone % 2 == 0 ? Crystal(axes, {1.486, 1.658, 1.658})
                                      : Crystal(axes, {1.53, 1.68, 1.69});
        for (int i = 0; i < 6; ++i) {
            const EyeRay ray = random_ray(random);
            const auto entry = body.entry(ray.origin, ray.direction);
            if (!entry) continue;
            const EyeFrame any{perpendicular_to(ray.direction), {}};
            Ways there;
            CrystalPaths<Ways>(body, band, limits, there)
                .trace(ray, any.x, glm::cross(any.x, ray.direction), *entry);
            for (const Ways::Way& way : there.ways) {
                const EyeRay back{way.at + 3.0 * way.direction, -way.direction};
                const auto again = body.entry(back.origin, back.direction);
                if (!again || again->facet != way.facets.back()) continue;  // grazing an edge
                const Vec3 x = perpendicular_to(back.direction);
                Ways reverse;
                CrystalPaths<Ways>(body, band, limits, reverse)
                    .trace(back, x, glm::cross(x, back.direction), *again);
                const std::vector<int> facets(way.facets.rbegin(), way.facets.rend());
                const std::string modes(way.modes.rbegin(), way.modes.rend());
                for (const Ways::Way& other : reverse.ways) {
                    if (other.facets != facets || other.modes != modes) continue;
                    worst = std::max(worst, std::abs(other.weight - way.weight));
                    ++compared;
                }
            }
        }
    }
    EXPECT_GT(compared, 500);
    EXPECT_LT(worst, 1e-13) << "seed " << seed;
}

TEST(CrystalPaths, BiaxialPlateIsDarkAtItsMelatopesAndAlongTheIsogyres) {
    // Optic axes lie in the plane of alpha and gamma at angle V from gamma, tan^2 V = (1/a^2 -
    // 1/b^2) / (1/b^2 - 1/c^2) with the indices a, b, c (Born & Wolf 15.3.3). Light along an axis
    // keeps its polarisation. It enters the plate normal to gamma at sin = n_beta sin V.
    const double a = 1.6, b = 1.605, c = 1.62, thickness = 0.6;
    const double V =
        std::atan(std::sqrt((1 / (a * a) - 1 / (b * b)) / (1 / (b * b) - 1 / (c * c))));
    const StoneBody body(slab(thickness), true);
    Band band;
    band.coherence_length = std::numeric_limits<double>::infinity();
    band.wavelength = 550e-6;
    PathLimits limits;
    limits.depth = 2;
    const auto crossed = [&](double sine, double polarizer) {
        const Vec3 d{sine, 0, -std::sqrt(1 - sine * sine)};
        PathSums sums;
        const EyeRay ray{Vec3{0.3, 0.2, 0} - 5.0 * d, d};
        const Vec3 forward{0, 0, -1};
        const Vec3 x = turned_with(forward, d, {1, 0, 0}), y = turned_with(forward, d, {0, 1, 0});
        CrystalPaths<PathSums>(body, band, limits, sums)
            .trace(ray, x, y, *body.entry(ray.origin, ray.direction));
        return between_polarisers(sums, 1, polarizer, polarizer + std::numbers::pi / 2);
    };
    // Axes at 45 degrees to the polariser: bright between the melatopes, dark at each; alpha along
    // x.
    band.crystal = Crystal({Vec3{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {a, b, c});
    const double melatope = b * std::sin(V), at_45 = std::numbers::pi / 4;
    // The faces' own rotation at this angle: the isotropic plate's crossed light.
    Band isotropic = band;
    isotropic.crystal = Crystal({Vec3{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {b, b, b});
    std::swap(band, isotropic);
    const double faces = crossed(melatope, at_45);
    std::swap(band, isotropic);
    // The crystal's faces differ from those of index b by the order of c - a.
    EXPECT_NEAR(crossed(melatope, at_45), faces, 0.1 * (c - a));
    double brightest = 0;
    for (double sine = 0; sine < melatope; sine += 0.002)
        brightest = std::max(brightest, crossed(sine, at_45));
    EXPECT_GT(brightest, 0.5);
    // Vibrations along the polariser: the trace of the axial plane is an isogyre.
    for (double sine = 0; sine < 0.9; sine += 0.1) EXPECT_LT(crossed(sine, 0), 1e-12) << sine;
}

TEST(CrystalPaths, UniaxialRingsLieWhereTheRetardationIsAWholeNumberOfWaves) {
    // Plate normal to the axis: G = d (q_e - q_o), q_o^2 = n_o^2 - K^2, q_e^2 = n_o^2 (1 - K^2 /
    // n_e^2) (Born & Wolf 15.3.2). Crossed polarisers at 45 degrees to the plane of incidence:
    // dark, except for the faces' own part, where G is m waves.
    const double n_o = 1.658, n_e = 1.486, thickness = 0.9, wavelength = 589e-6;
    const StoneBody body(slab(thickness), true);
    Band band;
    band.crystal = uniaxial_crystal({0, 0, 1}, n_o, n_e);
    band.coherence_length = std::numeric_limits<double>::infinity();
    band.wavelength = wavelength;
    PathLimits limits;
    limits.depth = 2;
    for (int m = 1; m <= 6; ++m) {
        double low = 0, high = 0.6;
        for (int step = 0; step < 60; ++step) {
            const double K = 0.5 * (low + high);
            const double G = thickness * (std::sqrt(n_o * n_o - K * K) -
                                          n_o * std::sqrt(1 - K * K / (n_e * n_e)));
            (G < m * wavelength ? low : high) = K;
        }
        const auto crossed = [&](double sine) {
            const Vec3 d{sine * std::sqrt(0.5), sine * std::sqrt(0.5), -std::sqrt(1 - sine * sine)};
            const EyeRay ray{Vec3{0.3, 0.2, 0} - 5.0 * d, d};
            const Vec3 forward{0, 0, -1};
            PathSums sums;
            CrystalPaths<PathSums>(body, band, limits, sums)
                .trace(ray, turned_with(forward, d, {1, 0, 0}), turned_with(forward, d, {0, 1, 0}),
                       *body.entry(ray.origin, ray.direction));
            return between_polarisers(sums, 1, 0, std::numbers::pi / 2);
        };
        // The two waves pass with T_s and T_p: where they are in phase (sqrt T_s - sqrt T_p)^2 / 4
        // remains, and halfway between rings they add.
        const double q1 = std::sqrt(1 - low * low);
        const double qo = std::sqrt(n_o * n_o - low * low);
        const double t_s = 4 * q1 * qo / ((q1 + qo) * (q1 + qo));
        const double qe = n_o * std::sqrt(1 - low * low / (n_e * n_e)), eo = n_o * n_o;
        const double t_p = 4 * eo * q1 * qe / ((eo * q1 + qe) * (eo * q1 + qe));
        EXPECT_NEAR(crossed(low), 0.25 * (t_s - t_p) * (t_s - t_p), 1e-10) << m;
    }
}

TEST(CrystalPaths, ChoicesAtRandomAreUnbiasedAndKnowTheirError) {
    // Against the whole tree: the sum over 400 rays of squared errors over variances is 400 +- 28
    // if the variances are right on average. Single variances are far from normal, so the bounds
    // are wide: a factor 2 either way.
    const unsigned seed = 5;
    std::mt19937_64 random(seed);
    struct Seen : Ways {
        double sum = 0, start = 0, first = 0, variance = 0;
        void path_exits(const PathEnd& end, const PathTrace&) {
            if (end.direction.z > 0) sum += end.coherency.power();
        }
        void roulette(const NodeWeights& w) { sum += 0.5 * w[0]; }
        void choice_begins() { start = sum; }
        void choice_ends(bool second) {
            const double brought = sum - start;
            if (second) variance += (brought - first) * (brought - first);
            first = brought;
        }
    };
    double errors = 0, variances = 0, bias = 0;
    for (int i = 0; i < 400; ++i) {
        const StoneBody body(random_stone(random, 12), true);
        Band band;
        band.crystal = Crystal(random_axes(random), {1.5, 1.6, 1.7});
        const EyeRay ray = random_ray(random);
        const auto entry = body.entry(ray.origin, ray.direction);
        if (!entry) continue;
        const Vec3 x = perpendicular_to(ray.direction), y = glm::cross(x, ray.direction);
        PathLimits limits;
        limits.depth = 9;
        Seen exact, chosen;
        CrystalPaths<Seen>(body, band, limits, exact).trace(ray, x, y, *entry);
        limits.split_weight = 0.1;
        limits.cut_weight = 0.02;
        limits.roulette = true;
        limits.seed = 1000 + i;
        CrystalPaths<Seen>(body, band, limits, chosen).trace(ray, x, y, *entry);
        const double error = chosen.sum - exact.sum;
        errors += error * error;
        bias += error;
        variances += chosen.variance;
    }
    EXPECT_GT(variances, 0);
    EXPECT_LT(errors, 2 * variances) << "seed " << seed;
    EXPECT_GT(errors, 0.5 * variances) << "seed " << seed;
    EXPECT_LT(std::abs(bias), 4 * std::sqrt(variances)) << "unbiased within 4 standard errors";
}

}  // namespace
