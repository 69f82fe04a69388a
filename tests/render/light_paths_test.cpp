// Expectations: energy balance (exits + remainder + absorbed + cut = 1), closed forms of a slab,
// and Beer and Lambert.

#include "render/reference/light_paths.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "stone/design/design.h"
#include "tests/render/ray_stones.h"

namespace {

using namespace culet;

struct Sums {
    double leaves = 0, left = 0, lost = 0, dropped = 0;
    std::vector<double> exit_weights;
    std::vector<Vec3> directions;
    void path_exits(const Vec3&, const Vec3& direction, const NodeWeights& w, const PathTrace&) {
        leaves += w[0];
        exit_weights.push_back(w[0]);
        directions.push_back(direction);
    }
    void remainder(const NodeWeights& w) { left += w[0]; }
    void absorbed(const NodeWeights& w) { lost += w[0]; }
    void cut(const NodeWeights& w) { dropped += w[0]; }
    double total() const { return leaves + left + lost + dropped; }
};

TEST(LightPaths, IsotropicWhiteFurnaceBalancesAtEveryDepth) {
    const unsigned seed = 1829;
    std::mt19937_64 random(seed);
    double worst = 0;
    for (int stone = 0; stone < 10; ++stone) {
        const ConvexBody body(random_stone(random, 30));
        Band band;
        band.n = 1 + 1.6 * (stone + 1) / 10.0;
        for (int i = 0; i < 40; ++i) {
            const EyeRay ray = random_ray(random);
            const auto entry = body.entry(ray.origin, ray.direction);
            if (!entry) continue;
            for (const bool polarised : {true, false}) {
                for (const int depth : {1, 2, 3, 8, 64, 1000}) {
                    Sums sums;
                    PathLimits limits;
                    limits.depth = depth;
                    limits.polarised = polarised;
                    LightPaths<Sums>(body, band, limits, sums).trace(ray, *entry);
                    worst = std::max(worst, std::abs(sums.total() - 1));
                }
            }
        }
    }
    EXPECT_LT(worst, 1e-12) << "seed " << seed;
}

// For a convex stone the tracer for any solid must agree with the tracer for planes.
TEST(LightPaths, GoThroughAnySolidAsThroughPlanes) {
    std::mt19937_64 random(411);
    double worst = 0;
    for (int stone = 0; stone < 5; ++stone) {
        const Solid solid = random_stone(random, 30);
        const ConvexBody planes(solid);
        const StoneBody any(solid, false);
        Band band;
        band.n = 1.7;
        for (int i = 0; i < 40; ++i) {
            const EyeRay ray = random_ray(random);
            const auto entry = planes.entry(ray.origin, ray.direction);
            if (!entry) continue;
            PathLimits limits;
            limits.depth = 5;
            Sums by_planes, by_any;
            LightPaths<Sums>(planes, band, limits, by_planes).trace(ray, *entry);
            LightPaths<Sums, false, StoneBody>(any, band, limits, by_any).trace(ray, *entry);
            ASSERT_EQ(by_any.exit_weights.size(), by_planes.exit_weights.size());
            for (std::size_t k = 0; k < by_any.exit_weights.size(); ++k)
                worst =
                    std::max(worst, std::abs(by_any.exit_weights[k] - by_planes.exit_weights[k]));
        }
    }
    EXPECT_LT(worst, 1e-9);
}

Solid with_ground(Solid solid, const std::string& facet) {
    Design design;
    design.tiers.push_back({{}, {}, {{0, facet, facet}}, 0.5});
    solid.design = std::make_shared<const Design>(std::move(design));
    return solid;
}

// Every ray keeps its light, and one that a ground facet splits goes on both ways.
TEST(LightPaths, GroundFacetsKeepAllLight) {
    std::mt19937_64 random(7);
    Solid solid = random_stone(random, 20);
    for (std::size_t f = 0; f < solid.facets.size(); ++f)
        solid.facets[f].name = f % 2 == 0 ? "ground" : "polished";
    const ConvexBody body(with_ground(solid, "ground"));
    const StoneBody any(with_ground(solid, "ground"), false);
    ASSERT_TRUE(body.has_ground());
    Band band;
    band.n = 1.76;
    band.absorbs = true;
    band.absorption[0][0] = 0.2;
    for (int i = 0; i < 200; ++i) {
        const EyeRay ray = random_ray(random);
        const auto entry = body.entry(ray.origin, ray.direction);
        if (!entry) continue;
        PathLimits limits;
        limits.depth = 1 + i % 30;
        limits.polarised = i % 3 > 0;
        limits.seed = std::uint64_t(i);
        Sums by_planes, by_any;
        LightPaths<Sums>(body, band, limits, by_planes).trace(ray, *entry);
        LightPaths<Sums, false, StoneBody>(any, band, limits, by_any).trace(ray, *entry);
        EXPECT_NEAR(by_planes.total(), 1, 1e-12);
        EXPECT_NEAR(by_any.total(), 1, 1e-12);
        EXPECT_NEAR(by_any.leaves, by_planes.leaves, 1e-9);
    }
}

// A plate that is ground on the far side: of what enters, the ground side lets 1 - i through, and
// scatters i to the polished side, which reflects i of it, as of all diffuse light. Judd's
// published reflectances (J. Res. NBS 29, 1942) for n = 1.5: 0.0918 from outside, 0.5963 from
// inside.
TEST(LightPaths, GroundPlatePassesTheDiffuseSeries) {
    EXPECT_NEAR(diffuse_reflectance(1.5), 0.0918, 2e-4);
    const double n = 1.5, inside = 1 - (1 - diffuse_reflectance(n)) / (n * n);
    EXPECT_NEAR(inside, 0.5963, 2e-4);
    Solid plate = slab(2);
    for (Facet& facet : plate.facets) {
        if (facet.plane.normal.z < -0.5) facet.name = "ground";
    }
    const ConvexBody body(with_ground(plate, "ground"));
    const EyeRay ray{{0.3, 0.2, 5}, {0, 0, -1}};
    Band band;
    band.n = n;
    double through = 0, back = 0, squares = 0;
    constexpr int k_rays = 20000;
    for (int i = 0; i < k_rays; ++i) {
        PathLimits limits;
        limits.depth = 200;
        limits.seed = std::uint64_t(i) * 7919;
        Sums sums;
        LightPaths<Sums>(body, band, limits, sums)
            .trace(ray, *body.entry(ray.origin, ray.direction));
        double down = 0;
        for (std::size_t k = 0; k < sums.directions.size(); ++k)
            (sums.directions[k].z < 0 ? down : back) += sums.exit_weights[k];
        through += down;
        squares += down * down;
    }
    through /= k_rays;
    const double sigma = std::sqrt((squares / k_rays - through * through) / k_rays);
    // The slab's rims are far away: what the ground side scatters meets the polished side next.
    const double R0 = std::pow((n - 1) / (n + 1), 2);
    const double expected = (1 - R0) * (1 - inside) / (1 - inside * inside);
    EXPECT_NEAR(through, expected, std::max(5 * sigma, 1e-3)) << back / k_rays;
}

TEST(LightPaths, SlabTransmitsTheClosedSeries) {
    // Incoherent plate at normal incidence: T = (1-R)/(1+R), R = ((n-1)/(n+1))^2.
    const ConvexBody body(slab(2));
    const EyeRay ray{{0.3, 0.2, 5}, {0, 0, -1}};
    for (const double n : {1.3, 1.54, 2.417}) {
        Band band;
        band.n = n;
        Sums sums;
        PathLimits limits;
        limits.depth = 200;
        LightPaths<Sums>(body, band, limits, sums)
            .trace(ray, *body.entry(ray.origin, ray.direction));
        double through = 0;
        for (std::size_t i = 0; i < sums.directions.size(); ++i) {
            if (sums.directions[i].z < 0) through += sums.exit_weights[i];
        }
        const double R = std::pow((n - 1) / (n + 1), 2);
        EXPECT_NEAR(through, (1 - R) / (1 + R), 1e-14);
    }
}

TEST(LightPaths, AbsorbingSlabFollowsBeerAndLambertAlongTheRay) {
    // Oblique plate: T = (1-R)^2 a / (1 - R^2 a^2) for s and p apart, a = exp(-K d / cos inside).
    const double thickness = 2, n = 1.7, K = 0.4, angle = 0.7;
    const ConvexBody body(slab(thickness));
    const EyeRay ray{{-5 * std::sin(angle), 0, 5 * std::cos(angle)},
                     {std::sin(angle), 0, -std::cos(angle)}};
    Band band;
    band.n = n;
    band.absorbs = true;
    band.absorption[0][0] = K;
    Sums sums;
    PathLimits limits;
    limits.depth = 200;
    LightPaths<Sums>(body, band, limits, sums).trace(ray, *body.entry(ray.origin, ray.direction));
    double through = 0;
    for (std::size_t i = 0; i < sums.directions.size(); ++i) {
        if (sums.directions[i].z < 0) through += sums.exit_weights[i];
    }
    const double inside = std::asin(std::sin(angle) / n),
                 a = std::exp(-K * thickness / std::cos(inside));
    const double Rs = std::pow(std::sin(angle - inside) / std::sin(angle + inside), 2);
    const double Rp = std::pow(std::tan(angle - inside) / std::tan(angle + inside), 2);
    const auto T = [a](double R) { return (1 - R) * (1 - R) * a / (1 - R * R * a * a); };
    EXPECT_NEAR(through, 0.5 * (T(Rs) + T(Rp)), 1e-14);
}

TEST(LightPaths, PolarisationIsRememberedFromFaceToFace) {
    // At Brewster's angle a plate passes all p at both faces, and s with (1-Rs)^2: the mean of the
    // two products is not the product of the means. First pass only (depth 2).
    const double n = 1.5, angle = std::atan(n);
    const ConvexBody body(slab(1));
    const EyeRay ray{{-5 * std::sin(angle), 0, 5 * std::cos(angle)},
                     {std::sin(angle), 0, -std::cos(angle)}};
    const double inside = std::asin(std::sin(angle) / n);
    const double Rs = std::pow(std::sin(angle - inside) / std::sin(angle + inside), 2);
    const auto second_exit = [&](bool polarised) {
        Band band;
        band.n = n;
        Sums sums;
        PathLimits limits;
        limits.depth = 2;
        limits.polarised = polarised;
        LightPaths<Sums>(body, band, limits, sums)
            .trace(ray, *body.entry(ray.origin, ray.direction));
        return sums.exit_weights.at(1);
    };
    EXPECT_NEAR(second_exit(true), 0.5 * (1 + (1 - Rs) * (1 - Rs)), 1e-15);
    EXPECT_NEAR(second_exit(false), std::pow(1 - 0.5 * Rs, 2), 1e-15);
}

TEST(LightPaths, CrossedPlaneReflectionsPolariseAsTheProductOfJonesMatrices) {
    // Two Brewster reflections in crossed planes of incidence extinguish light: p of the first is s
    // of the second. By hand from Jones matrices: cube of index n, a ray at 45 degrees meets the x
    // and then the y face.
    const double n = 1.3;
    const Vec3 inner = glm::normalize(Vec3{1, 1, 0.3});
    // The tree's exit weights must be the same for the mirrored path (a symmetry of the cube).
    std::vector<NamedPlane> planes;
    for (int axis = 0; axis < 3; ++axis) {
        for (int sign : {-1, 1}) {
            Vec3 normal{0, 0, 0};
            normal[axis] = sign;
            planes.push_back({"f", {normal, 1}});
        }
    }
    const ConvexBody body(intersect_half_spaces(planes).solid);
    const auto weights = [&](const EyeRay& ray) {
        Band band;
        band.n = n;
        Sums sums;
        PathLimits limits;
        limits.depth = 6;
        LightPaths<Sums>(body, band, limits, sums)
            .trace(ray, *body.entry(ray.origin, ray.direction));
        return sums.exit_weights;
    };
    const Vec3 start{0.1, 0.25, 3};
    const Vec3 direction = glm::normalize(Vec3{inner.x * 0.3, inner.y * 0.2, -1});
    const auto a = weights({start, direction});
    const auto b = weights({{start.y, start.x, start.z}, {direction.y, direction.x, direction.z}});
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 1e-15);
}

TEST(ConvexBody, RayAlongAnEdgeOrThroughACornerStillLeaves) {
    std::vector<NamedPlane> planes;
    for (int axis = 0; axis < 3; ++axis) {
        for (int sign : {-1, 1}) {
            Vec3 n{0, 0, 0};
            n[axis] = sign;
            planes.push_back({"f", {n, 1}});
        }
    }
    const ConvexBody body(intersect_half_spaces(planes).solid);
    const BodyHit corner = body.exit({0, 0, 0}, glm::normalize(Vec3{1, 1, 1}));
    EXPECT_NEAR(corner.distance, std::sqrt(3.0), 1e-15);
    EXPECT_EQ(corner.facet, 1) << "of equally near planes the first";
    EXPECT_FALSE(body.entry({3, 1.0000001, 0}, {-1, 0, 0}).has_value());
    EXPECT_TRUE(body.entry({3, 0.9999999, 0}, {-1, 0, 0}).has_value());
    EXPECT_FALSE(body.entry({3, 3, 3}, {1, 1, 1}).has_value()) << "runs away from the stone";
}

}  // namespace
