// Better angles: meets are compared with the planes that make them, merits with a second
// calculation.

#include "render/optimize/optimize.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>

#include "stone/cuts/cuts.h"
#include "stone/design/drawn_symmetry.h"
#include "stone/text/errors.h"

namespace culet {
namespace {

// Six crown and six pavilion facets, each set meeting in an apex, round an upright girdle from
// -thickness to +thickness at distance 1.
Solid double_pyramid(double crown, double pavilion, double thickness) {
    std::vector<NamedPlane> planes;
    for (int i = 0; i < 6; ++i) {
        const double azimuth = i * std::numbers::pi / 3;
        const Vec3 out{std::cos(azimuth), std::sin(azimuth), 0};
        const auto facet = [&](const char* name, double angle, double side) {
            const Vec3 normal = std::sin(angle) * out + Vec3{0, 0, side * std::cos(angle)};
            planes.push_back({name + std::to_string(i + 1),
                              {normal, glm::dot(normal, out + Vec3{0, 0, side * thickness})}});
        };
        facet("C", crown, 1);
        facet("P", pavilion, -1);
        planes.push_back({"G" + std::to_string(i + 1), {out, 1}});
    }
    return contract_near_meets(intersect_half_spaces(planes).solid, 1e-9).solid;
}

double highest(const Solid& solid) {
    double z = 0;
    for (const Vec3& v : solid.vertices) z = std::max(z, v.z);
    return z;
}

TEST(TierDesign, OfADoublePyramidKeepsItsApexes) {
    const TierDesign design(double_pyramid(radians(35), radians(42), 0.05));
    ASSERT_EQ(design.tiers().size(), 2u);
    for (const double more : {-10.0, -1.0, 0.0, 3.0, 12.0}) {
        std::vector<double> steeper(2, 0);
        for (std::size_t t = 0; t < 2; ++t) {
            if (design.tiers()[t].part == StonePart::crown) steeper[t] = radians(more);
        }
        const std::optional<Solid> solid = design.with(steeper);
        ASSERT_TRUE(solid) << more;
        // The girdle stays, so the apex is that of a pyramid over it.
        EXPECT_NEAR(highest(*solid), 0.05 + std::tan(radians(35 + more)), 1e-12) << more;
    }
}

TEST(TierDesign, OfABrilliantKeepsMeetsAzimuthsAndGirdle) {
    const Solid start = make_cut("round-brilliant");
    const TierDesign design(start);
    std::vector<double> steeper;
    // Lower halves must stay steeper than the mains, or they vanish.
    const std::map<std::string, double> wanted{
        {"S", -1}, {"C", 0.6}, {"U", -0.5}, {"L", 1.2}, {"P", -0.8}};
    for (const FacetTier& tier : design.tiers()) steeper.push_back(radians(wanted.at(tier.name)));
    const std::optional<Solid> solid = design.with(steeper);
    ASSERT_TRUE(solid);
    std::vector<double> turn(start.facets.size(), 0);
    for (std::size_t t = 0; t < steeper.size(); ++t) {
        for (const int f : design.tiers()[t].facets) turn[static_cast<std::size_t>(f)] = steeper[t];
    }
    for (std::size_t f = 0; f < start.facets.size(); ++f) {
        const Facet &was = start.facets[f], &is = solid->facets[f];
        EXPECT_EQ(is.corners, was.corners);
        // Corners are computed from planes whose numbers have the size of the stone.
        for (const int c : is.corners)
            EXPECT_NEAR(height_above(is.plane, solid->vertices[static_cast<std::size_t>(c)]), 0,
                        1e-12 * diameter(start));
        const Vec3 a = was.plane.normal, b = is.plane.normal;
        EXPECT_NEAR(a.x * b.y - a.y * b.x, 0, 1e-13) << is.name;
        if (std::abs(a.z) < 1e-9) {
            EXPECT_EQ(a, b);
            EXPECT_EQ(was.plane.offset, is.plane.offset);
        } else if (turn[f] != 0) {
            const double from = std::atan2(std::hypot(a.x, a.y), std::abs(a.z));
            const double to = std::atan2(std::hypot(b.x, b.y), std::abs(b.z));
            // The nearest cut with these meets: the wanted angles, except where meets tie them.
            EXPECT_NEAR(to - from, turn[f], radians(0.2)) << is.name;
        }
    }
}

TEST(TierDesign, IsRefusedWhereFacetsWouldVanish) {
    const Solid start = make_cut("round-brilliant");
    const TierDesign design(start);
    for (std::size_t t = 0; t < design.tiers().size(); ++t) {
        // Mains as flat as stars, stars as steep as mains: facets change their outline.
        std::vector<double> steeper(design.tiers().size(), 0);
        steeper[t] = radians(45);
        const std::optional<Solid> solid = design.with(steeper);
        if (!solid) continue;
        for (const Facet& facet : solid->facets) EXPECT_GT(area(*solid, facet), 0);
    }
    EXPECT_FALSE(design.with(std::vector<double>(design.tiers().size(), radians(60))));
}

OptimizeOptions quick(double n) {
    OptimizeOptions options;
    options.merit.index.n = n;
    options.evaluations = 40;
    return options;
}

TEST(Optimize, IsAtLeastItsStartAndTheSearchWithTwoFactors) {
    const Solid start = make_cut("round-brilliant");
    const OptimizeOptions options = quick(1.54);
    const Optimized result = optimize_cut(start, options);
    EXPECT_TRUE(result.found);
    EXPECT_GE(result.by_two_factors.total, result.at_start.total);
    EXPECT_GE(result.at_better.total, result.by_two_factors.total);
    // Computes the merit again with grade: cosine light over the same tilts.
    GradeOptions grade;
    grade.coarse = true;
    for (int deg = -30; deg <= 30; deg += 10) grade.tilts.push_back(radians(deg));
    grade.tilt_axes = {0};
    const Grade graded = grade_stone(result.better, options.merit.index, grade);
    double sum = 0;
    for (const ViewReturn& view : graded.curves.front().returns)
        sum += view.whole[static_cast<std::size_t>(LightModel::cos)];
    EXPECT_NEAR(result.at_better.total, 100 * sum / 7, 1e-9);
}

// Left and right lower halves under two names, as designs have them (P3, P21): they share one angle
// by the drawing's symmetry, eightfold with mirrors.
Solid brilliant_of_two_names() {
    Solid solid = make_cut("round-brilliant");
    int number = 0;
    for (Facet& facet : solid.facets) {
        if (facet.name.starts_with("L"))
            facet.name = (++number % 2 == 0 ? "A." : "B.") + facet.name.substr(1);
    }
    return solid;
}

TEST(Optimize, KeepsSymmetryAndEveryFacet) {
    const Solid start = brilliant_of_two_names();
    const TierDesign design(start);
    EXPECT_EQ(design.tiers().size(), design.tied_tiers().size() + 1);
    OptimizeOptions options = quick(1.54);
    options.evaluations = 120;
    const Optimized result = optimize_cut(start, options);
    ASSERT_TRUE(result.found);
    const DrawnSymmetry kept =
        drawn_symmetry(result.better, {0, 0, 1}, table_facet(start, {0, 0, 1}));
    EXPECT_EQ(kept.group.name(), "C8v");
    for (const FacetOrbit& orbit : orbits_of(kept.group, start.facets.size())) {
        for (const int f : orbit.facets) {
            // Meets close to rounding error at the stone's size.
            EXPECT_NEAR(result.better.facets[std::size_t(f)].plane.normal.z,
                        result.better.facets[std::size_t(orbit.facets[0])].plane.normal.z, 1e-11);
        }
    }
    // It reads back whole as a design: nothing is so small that a reader takes it for a near miss.
    const double least = 0.005 * diameter(start);
    for (const Facet& facet : result.better.facets) {
        for (std::size_t i = 0; i < facet.corners.size(); ++i) {
            const auto a = std::size_t(facet.corners[i]),
                       b = std::size_t(facet.corners[(i + 1) % facet.corners.size()]);
            const double was = glm::length(start.vertices[a] - start.vertices[b]);
            EXPECT_GE(glm::length(result.better.vertices[a] - result.better.vertices[b]),
                      std::min(was / 2, least) * (1 - 1e-6));
        }
    }
}

TEST(Optimize, GivesTheBestSoFarWhereItIsStopped) {
    int calls = 0;
    const Optimized result = optimize_cut(make_cut("round-brilliant"), quick(1.54),
                                          [&](double) { return ++calls < 15; });
    EXPECT_TRUE(result.interrupted);
    EXPECT_EQ(result.evaluations, 15);
    EXPECT_GE(result.at_better.total, result.at_start.total);
}

TEST(Optimize, IsTheSameOnAnyNumberOfThreads) {
    const Solid start = double_pyramid(radians(35), radians(42), 0.05);
    OptimizeOptions options = quick(1.76);
    options.merit.threads = 1;
    const Optimized one = optimize_cut(start, options);
    options.merit.threads = 3;
    const Optimized three = optimize_cut(start, options);
    EXPECT_EQ(one.at_better.total, three.at_better.total);
    for (std::size_t v = 0; v < one.better.vertices.size(); ++v)
        EXPECT_EQ(one.better.vertices[v], three.better.vertices[v]);
}

TEST(Optimize, KeepsItsLimits) {
    const Solid start = make_cut("round-brilliant");
    OptimizeOptions options = quick(1.54);
    options.limits.range = radians(1);
    options.limits.least_table = table_share(start) - 0.01;
    options.limits.most_table = table_share(start) + 0.01;
    options.limits.least_volume = 0.99;
    const Optimized result = optimize_cut(start, options);
    EXPECT_GE(table_share(result.better), options.limits.least_table);
    EXPECT_LE(table_share(result.better), options.limits.most_table);
    EXPECT_GE(result.volume_ratio, 0.99);
    for (const OptimizedTier& tier : result.tiers)
        EXPECT_LE(std::abs(tier.to - tier.from), radians(1.2)) << tier.tier.name;
}

TEST(Optimize, CutsAStoneAnewInsideWhatIsThere) {
    const Solid stone = double_pyramid(radians(30), radians(38), 0.05);
    OptimizeOptions options = quick(1.76);
    options.recut = Recut{.gain = 0, .most_loss = 0.2};
    const Optimized result = optimize_cut(stone, options);
    for (const Facet& facet : stone.facets) {
        for (const Vec3& corner : result.better.vertices)
            EXPECT_LE(height_above(facet.plane, corner), 1e-12 * diameter(stone));
    }
    EXPECT_NEAR(volume(result.better) / volume(stone), result.volume_ratio, 1e-12);
    EXPECT_GE(result.volume_ratio, 0.8);
    EXPECT_GE(result.at_better.total, result.at_start.total);
    // The girdle keeps its place on the axis, its middle at height 0, up to the copy's scale.
    double low = 0, high = 0;
    const Solid design = about_its_axis(result);
    for (const Facet& facet : design.facets) {
        if (std::abs(facet.plane.normal.z) > 1e-9) continue;
        for (const int c : facet.corners) {
            low = std::min(low, design.vertices[std::size_t(c)].z);
            high = std::max(high, design.vertices[std::size_t(c)].z);
        }
    }
    EXPECT_GT(high, 0);
    EXPECT_NEAR(low, -high, 1e-9);
}

TEST(Optimize, RefusesWordsThatItDoesNotKnow) {
    EXPECT_EQ(merit_weights("brilliance=2,tilt"), (std::array<double, 4>{2, 0, 0, 1}));
    for (const char* text : {"", "glitter", "fire=", "fire=x", "fire=-1", "fire=0", "fire,,tilt"})
        EXPECT_THROW(merit_weights(text), InputError) << text;
}

}  // namespace
}  // namespace culet
