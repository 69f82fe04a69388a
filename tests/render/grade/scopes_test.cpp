// Scopes, hearts and arrows, uncertainties: against geometry and the trade's rules.

#include <gtest/gtest.h>

#include "render/grade/grade.h"
#include "render/grade/grade_figures.h"
#include "render/grade/grade_sigma.h"
#include "render/grade/path_section.h"
#include "stone/text/errors.h"
#include "stone/upright.h"
#include "tests/render/grade/round_brilliants.h"

namespace culet {
namespace {

using test::round_brilliant;
using test::RoundProportions;
using test::with_error;

// Diamond at the sodium line.
constexpr double k_diamond_d = 2.4176;
// The middle of the trade's proportions for hearts and arrows.
const RoundProportions k_ideal{.table = 56, .lower = 77};

struct Found {
    Hearts hearts;
    Arrows arrows;
};

Found found_in(const Solid& solid) {
    const EyeLightTracer tracer(solid);
    const EyeLightLimits limits{.regions = true};
    return {find_hearts(scope_map(tracer.trace({0, 0, -1}, k_diamond_d, limits),
                                  reflector_bands(true), 600)),
            find_arrows(
                scope_map(tracer.trace({0, 0, 1}, k_diamond_d, limits), reflector_bands(), 600))};
}

// Light straight down through the table is reflected by two opposite mains and leaves at n sin(180
// - 4 p) to the vertical: 45 degrees, where ASET's red ends, at p = 40.75 for diamond (AGS: 40.76).
// Steeper mains send it closer to the vertical, into red.
TEST(Scopes, TheTablesAsetColourFlipsAtAPavilionOf40Point76) {
    const auto reflection_at = [](double pavilion) {
        const Solid solid = round_brilliant({.table = 57, .pavilion = pavilion, .lower = 77});
        const EyeLight light = EyeLightTracer(solid).trace({0, 0, 1}, k_diamond_d);
        return table_reflection(light, find_facet(solid, "T"));
    };
    const auto green_at = [](double pavilion) {
        const Solid solid = round_brilliant({.table = 57, .pavilion = pavilion, .lower = 77});
        const EyeLight light = EyeLightTracer(solid).trace({0, 0, 1}, k_diamond_d);
        return aset_shares(light, find_facet(solid, "T")).green;
    };
    EXPECT_STREQ(reflection_at(40.76 + 0.05).colour, "red");
    EXPECT_STREQ(reflection_at(40.76 - 0.05).colour, "green");
    for (const double pavilion : {40.0, 40.7, 41.0}) {
        const double out = std::asin(k_diamond_d * std::sin(radians(180 - 4 * pavilion)));
        EXPECT_NEAR(reflection_at(pavilion).elevation, radians(90) - out, 1e-9) << pavilion;
    }
    // The table's share of green changes at once by that of this reflection, which is one beam.
    const double share = reflection_at(40.71).share;
    EXPECT_GT(share, 0.05);
    EXPECT_NEAR(green_at(40.71) - green_at(40.81), share, 0.01);
}

TEST(Scopes, SharesSumToOne) {
    for (const double pavilion : {35.0, 41.0, 46.0}) {
        const EyeLight light =
            EyeLightTracer(round_brilliant({.pavilion = pavilion})).trace({0, 0, 1}, 1.77);
        for (const int facet : {-1, 0}) {
            const AsetShares aset = aset_shares(light, facet);
            EXPECT_NEAR(aset.red + aset.green + aset.blue + aset.dark, 1, 1e-9);
        }
        const ScopeShares scope = ideal_scope_shares(light);
        EXPECT_NEAR(scope.red + scope.dark + scope.white, 1, 1e-9);
        // What the dark field shows is leakage.
        EXPECT_LE(dark_field_share(light), scope.white + 1e-12);
    }
}

// A stone of eight has eight of each, all equal up to the map's resolution: an area of 1.3 % of the
// silhouette is 2800 points, of which the 200 on the outline are off by half a point each.
TEST(Scopes, EightHeartsAndEightArrowsAreFound) {
    const Found found = found_in(round_brilliant(k_ideal));
    EXPECT_EQ(found.hearts.count, 8);
    EXPECT_EQ(found.arrows.count, 8);
    EXPECT_EQ(found.arrows.list.size(), 8u);
    EXPECT_GT(found.hearts.evenness, 0.995);
    EXPECT_GT(found.arrows.evenness, 0.995);
    EXPECT_GT(found.hearts.cleft, 0.05);
    EXPECT_GT(found.hearts.cleft_evenness, 0.99);
    for (std::size_t i = 0; i < 8; ++i) {
        // Hearts between the mains, arrows along them.
        const double heart = degrees(found.hearts.list[i].azimuth) / 22.5;
        const double arrow = degrees(found.arrows.list[i].azimuth) / 45;
        EXPECT_NEAR(std::abs(heart - std::round(heart)), 0, 0.02);
        EXPECT_EQ(static_cast<int>(std::abs(std::round(heart))) % 2, 1);
        EXPECT_NEAR(arrow, std::round(arrow), 0.02);
    }
}

// Half a degree on one facet shows in some figure, far beyond the map's resolution (0.005).
TEST(Scopes, HalfADegreeOnOneFacetIsSeen) {
    const Solid ideal = round_brilliant(k_ideal);
    for (const char* facet : {"P3", "C3", "L3a", "S3"}) {
        for (const double error : {0.5, -0.5}) {
            const Found found = found_in(with_error(ideal, facet, error));
            const double worst = std::min(
                {found.hearts.evenness, found.arrows.evenness, found.hearts.cleft_evenness});
            EXPECT_LT(worst, 0.993) << facet << " " << error;
        }
    }
    // A pavilion main moves its own arrows and hearts.
    for (const double error : {0.5, -0.5}) {
        const Found found = found_in(with_error(ideal, "P3", error));
        EXPECT_LT(std::min(found.hearts.evenness, found.arrows.evenness), 0.95);
    }
}

TEST(Scopes, NoHeartsAreFoundInAStepCutPavilionWithoutAny) {
    // Flat mains: the pavilion returns no light of the reflector.
    const Found found = found_in(round_brilliant({.pavilion = 25}));
    EXPECT_NE(found.arrows.count, 8);
}

// Small errors propagate by the figure's slope: the standard deviation of draws is the slope times
// sigma, to three times the error of a standard deviation from 30 draws (1/sqrt(2 x 29) = 13 %). A
// table, and eight facets each of crown, girdle and pavilion grade quickly.
Solid plain_eight() {
    std::vector<NamedPlane> planes{{"T", {{0, 0, 1}, 0.35}}};
    for (int i = 0; i < 8; ++i) {
        const double azimuth = radians(45.0 * i);
        for (const auto& [name, slope, side] : {std::tuple("C", radians(34), 1.0),
                                                {"G", radians(90), 1.0},
                                                {"P", radians(41), -1.0}}) {
            const Vec3 normal{std::sin(slope) * std::cos(azimuth),
                              std::sin(slope) * std::sin(azimuth), side * std::cos(slope)};
            const Vec3 at{std::cos(azimuth), std::sin(azimuth), side * 0.02};
            planes.push_back({name + std::to_string(i), {normal, glm::dot(normal, at)}});
        }
    }
    return intersect_half_spaces(planes).solid;
}

TEST(GradeSigma, IsTheSlopeTimesSigma) {
    const Solid solid = plain_eight();
    const GradeIndex index{k_diamond_d, {}};
    GradeOptions options;
    options.tilts = {radians(-10), 0};
    const int main = find_facet(solid, "P3");
    const double sigma = radians(0.005);
    StoneUncertainty uncertainty;
    uncertainty.facets.resize(solid.facets.size());
    uncertainty.facets[static_cast<std::size_t>(main)].inclination = sigma;
    const GradeSigma found = grade_sigma(solid, index, options, uncertainty, 30);
    EXPECT_EQ(found.draws, 30);
    EXPECT_EQ(found.left_out, 0);
    // Without tilt a curve is the face-up figure of the same stones.
    ASSERT_EQ(found.curves.size(), 2u);
    const auto cosine = static_cast<std::size_t>(LightModel::cos);
    for (const TiltCurve& curve : found.curves)
        // Both have rounding errors of 1e-16 of the return, ten thousand times less than sigma.
        EXPECT_NEAR(100 * curve.returns[1].whole[cosine], found.figures.at("cos"),
                    1e-10 * found.figures.at("cos"));

    // The same turn about the foot of the perpendicular from the mean corner.
    Vec3 middle(0);
    for (const Vec3& v : solid.vertices) middle += v / static_cast<double>(solid.vertices.size());
    const auto cos_return = [&](double by) {
        std::vector<NamedPlane> planes;
        for (const Facet& facet : solid.facets) {
            Plane plane = facet.plane;
            if (facet.name == "P3") {
                const double slope =
                    std::atan2(std::hypot(plane.normal.x, plane.normal.y), -plane.normal.z) + by;
                const double azimuth = std::atan2(plane.normal.y, plane.normal.x);
                const double height = plane.offset - glm::dot(plane.normal, middle);
                plane.normal = {std::sin(slope) * std::cos(azimuth),
                                std::sin(slope) * std::sin(azimuth), -std::cos(slope)};
                plane.offset = height + glm::dot(plane.normal, middle);
            }
            planes.push_back({facet.name, plane});
        }
        const EyeLight light =
            EyeLightTracer(intersect_half_spaces(planes).solid).trace({0, 0, 1}, k_diamond_d);
        return 100 * light_return(light, -1, options.head, RandomSky(1, k_diamond_d)).whole[1];
    };
    const double slope = (cos_return(sigma) - cos_return(-sigma)) / 2;
    EXPECT_NEAR(found.figures.at("cos") / std::abs(slope), 1, 0.4);
    EXPECT_GT(found.figures.at("cos"), 0);
}

// Correlated errors add: the same error of eight mains does not average out.
TEST(GradeSigma, KnowsCorrelatedErrors) {
    const Solid solid = plain_eight();
    StoneUncertainty apart, together;
    const std::size_t size = 3 * solid.facets.size();
    apart.facets.resize(solid.facets.size());
    together.facets = apart.facets;
    together.covariance.assign(size * size, 0);
    const double variance = radians(0.01) * radians(0.01);
    for (std::size_t i = 0; i < solid.facets.size(); ++i) {
        if (solid.facets[i].name[0] != 'P') continue;
        apart.facets[i].inclination = radians(0.01);
        for (std::size_t j = 0; j < solid.facets.size(); ++j) {
            if (solid.facets[j].name[0] == 'P')
                together.covariance[3 * i * size + 3 * j] = variance;
        }
    }
    const GradeIndex index{k_diamond_d, {}};
    const GradeSigma alone = grade_sigma(solid, index, {}, apart, 24);
    const GradeSigma all = grade_sigma(solid, index, {}, together, 24);
    EXPECT_FALSE(alone.correlated);
    EXPECT_TRUE(all.correlated);
    // For eight equal slopes s: s sqrt(8) against 8 s, a ratio of 2.8. Each is known to 1/sqrt(2 x
    // 23) = 15 %, the ratio to 21 %; less three of these is 1.8.
    const double ratio = all.figures.at("cos") / alone.figures.at("cos");
    EXPECT_NEAR(ratio, std::sqrt(8.0), 1.8);
    EXPECT_GT(ratio, 1);
}

TEST(FacetCosts, NamesTheFacetThatIsOff) {
    const Solid ideal = round_brilliant(k_ideal);
    const GradeIndex index{k_diamond_d, {}};
    EXPECT_TRUE(facet_costs(ideal, index, {}).empty());
    const Solid flawed = with_error(ideal, "P3", -0.8);
    const std::vector<FacetCost> costs = facet_costs(flawed, index, {});
    ASSERT_FALSE(costs.empty());
    EXPECT_EQ(flawed.facets[static_cast<std::size_t>(costs.front().facet)].name, "P3");
    // Seven eighths of the error: the tier's mean has the rest.
    EXPECT_NEAR(degrees(costs.front().off), -0.8 * 7 / 8, 1e-6);
}

TEST(PathSection, ShowsTheTextbooksPath) {
    const PathSection section = path_section(round_brilliant(), k_diamond_d, radians(10));
    EXPECT_GE(section.outline.size(), 7u);
    ASSERT_EQ(section.paths.size(), 13u);
    // Through the table off centre: two mains, then out of the crown.
    int returned = 0, leaked = 0;
    for (const SectionPath& path : section.paths) {
        returned += path.end == SectionEnd::returned || path.end == SectionEnd::head;
        leaked += path.end == SectionEnd::leak;
    }
    EXPECT_GE(returned, 10);
    // The same stone with a flat pavilion is a window.
    const PathSection window = path_section(round_brilliant({.pavilion = 15}), 1.54, radians(10));
    int through = 0;
    for (const SectionPath& path : window.paths) through += path.end == SectionEnd::leak;
    EXPECT_GT(through, 6);
    EXPECT_LT(leaked, 3);
}

// As written by a program that adds errors to facets: meets that miss, outlines that intersect
// themselves by rounding error.
TEST(Grade, TakesStonesWhoseMeetsMiss) {
    Solid flawed = with_error(round_brilliant(k_ideal), "P3", -0.5);
    for (Vec3& v : flawed.vertices) v += 1e-7 * Vec3{std::sin(1e7 * v.x), std::sin(1e7 * v.y), 0};
    GradeOptions options;
    options.coarse = true;
    EXPECT_GT(grade_stone(flawed, {k_diamond_d, {}}, options).balance.useful, 0.5);
    // A dent is not such an error.
    Solid dented = round_brilliant(k_ideal);
    for (Vec3& v : dented.vertices)
        if (v.z < -0.8) v.z = -0.2;
    EXPECT_THROW(grade_stone(dented, {k_diamond_d, {}}, options), InputError);
}

TEST(Upright, TurnsAStoneThatLiesOnItsSide) {
    Stone stone;
    stone.solid = round_brilliant();
    for (Facet& facet : stone.solid.facets)
        facet.plane.normal = {facet.plane.normal.z, facet.plane.normal.x, facet.plane.normal.y};
    for (Vec3& v : stone.solid.vertices) v = {v.z, v.x, v.y};
    stone.up_facet = "T";
    const Stone turned = standing_upright(stone);
    const int table = find_facet(turned.solid, "T");
    EXPECT_NEAR(turned.solid.facets[static_cast<std::size_t>(table)].plane.normal.z, 1, 1e-15);
    EXPECT_NEAR(width_along(turned.solid, {0, 0, 1}), width_along(stone.solid, {1, 0, 0}), 1e-12);
}

}  // namespace
}  // namespace culet
