// Edges and facets that the readings contradict or leave open, by name.
#include "fit/hypotheses/topology.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "fit/mesh/degenerate_parts.h"
#include "stone/solid/checks.h"
#include "tests/fit/test_stones.h"

namespace culet {
namespace {

using namespace test;

/// A hip roof over a box: the ridge joins N and S when `along` > `across`, E and W when it is less;
/// all four planes meet when they are equal.
Solid roof(double along, double across) {
    const double s = std::sqrt(0.5);
    // Slopes of 45 degrees with eaves at +-along and +-across at z = 0.
    return enclosed({{"E", {{s, 0, s}, s * along}},
                     {"W", {{-s, 0, s}, s * along}},
                     {"N", {{0, s, s}, s * across}},
                     {"S", {{0, -s, s}, s * across}},
                     {"B", {{0, 0, -1}, 0}}});
}

Stone standing(Solid solid) {
    Stone stone = stone_of(std::move(solid), "");
    stone.up_facet.clear();
    stone.azimuth_from_mesh = true;
    return stone;
}

/// Angles and eaves: they fix the four slopes and contain no reading of the ridge itself.
std::vector<Reading> roof_readings(const Solid& mesh, const Solid& truth, double sigma_deg,
                                   double sigma) {
    std::vector<Reading> readings;
    const int bottom = find_facet(mesh, "B");
    for (const Reading& r : plane_readings(mesh, truth, sigma_deg, sigma)) {
        const bool is_length = r.kind == ReadingKind::edge || r.kind == ReadingKind::depth;
        const bool is_eave =
            r.kind == ReadingKind::edge && (r.facets[0] == bottom || r.facets[1] == bottom);
        if (!is_length || is_eave) readings.push_back(r);
    }
    return readings;
}

const ShapeFinding* finding(const FitResult& result, ShapeFinding::Kind kind) {
    for (const ShapeFinding& f : result.findings.shapes) {
        if (f.kind == kind) return &f;
    }
    return nullptr;
}

bool has_edge(const Solid& solid, const std::string& a, const std::string& b) {
    const int f = find_facet(solid, a), g = find_facet(solid, b);
    for (const Edge& e : half_edges(solid).edges) {
        if ((e.left == f && e.right == g) || (e.left == g && e.right == f)) return true;
    }
    return false;
}

TEST(Topology, ARidgeThatWantsToLieAcrossIsNamed) {
    const Solid mesh = roof(1.1, 1), truth = roof(1, 1.1);
    ASSERT_TRUE(has_edge(mesh, "N", "S"));
    ASSERT_TRUE(has_edge(truth, "E", "W"));
    const std::vector<Reading> readings = noisy(roof_readings(mesh, truth, 0.1, 0.005), 1);
    const FitResult result = fit_stone(standing(mesh), readings);
    const ShapeFinding* edge = finding(result, ShapeFinding::Kind::edge_vanishes);
    ASSERT_NE(edge, nullptr) << result.message;
    EXPECT_THAT(std::vector<std::string>(edge->facets.begin(), edge->facets.begin() + 2),
                ::testing::UnorderedElementsAre("N", "S"));
    EXPECT_LT(edge->p, 1e-6);
    EXPECT_NE(result.status, FitStatus::converged);
    EXPECT_THAT(result.message,
                ::testing::AnyOf(::testing::HasSubstr("N|S"), ::testing::HasSubstr("S|N"),
                                 ::testing::HasSubstr("N/S"), ::testing::HasSubstr("S/N")));
    EXPECT_TRUE(result.checks.closed && result.checks.convex);
    // The mesh's ridge shrinks to nothing as the other one grows: its length is 2 (along - across)
    // of the truth.
    EXPECT_NEAR(edge->value, -0.2, 0.05);
    EXPECT_TRUE(result.log.changes.empty());
}

TEST(Topology, ARidgeIsTurnedWhereThatIsAllowed) {
    const Solid mesh = roof(1.1, 1), truth = roof(1, 1.1);
    FitOptions options;
    options.allow_topology = true;
    // With hips and depth read as well no edge is driven to zero: the readings contradict each
    // other under the mesh's topology, and the fit tries removing short edges.
    for (const bool all : {false, true}) {
        const std::vector<Reading> readings = noisy(
            all ? plane_readings(mesh, truth, 0.1, 0.005) : roof_readings(mesh, truth, 0.1, 0.005),
            1);
        const FitResult result = fit_stone(standing(mesh), readings, options);
        if (all) {
            EXPECT_EQ(result.status, FitStatus::converged) << result.message;
        }
        EXPECT_GT(result.statistics.chi2_p, 0.001);
        EXPECT_TRUE(has_edge(result.solid, "E", "W"));
        EXPECT_FALSE(has_edge(result.solid, "N", "S"));
        EXPECT_THAT(find_faults(result.solid), ::testing::IsEmpty());
        EXPECT_THAT(result.log.changes, ::testing::Contains("edges gone: N|S"));
        EXPECT_THAT(result.log.changes, ::testing::Contains("edges new: E|W"));
        EXPECT_EQ(result.readings.size(), readings.size());
        EXPECT_NEAR(width_along(result.solid, {0, 0, 1}), width_along(truth, {0, 0, 1}), 0.02);
    }
}

Solid bevelled(double offset) {
    const double s = std::sqrt(0.5);
    return enclosed({{"T", {{0, 0, 1}, 1}},
                     {"bevel", {{s, 0, s}, offset * s}},
                     {"X+", {{1, 0, 0}, 1}},
                     {"Y+", {{0, 1, 0}, 1}},
                     {"X-", {{-1, 0, 0}, 1}},
                     {"Y-", {{0, -1, 0}, 1}},
                     {"B", {{0, 0, -1}, 1}}});
}

std::vector<Reading> readings_without_bevel(const Solid& mesh) {
    const Solid box = cube();
    std::vector<Reading> readings = plane_readings(mesh, box, 0.05, 0.002);
    readings.push_back(
        reading(ReadingKind::inclination, {find_facet(mesh, "bevel")}, radians(45), radians(0.05)));
    readings.push_back(
        reading(ReadingKind::azimuth, {find_facet(mesh, "bevel")}, 0, radians(0.05)));
    for (const char* side : {"X+", "Y+", "X-", "Y-"}) {
        readings.push_back(reading(ReadingKind::inclination, {find_facet(mesh, side)}, radians(90),
                                   radians(0.05)));
    }
    return readings;
}

// Edges, angles and depth of a whole box: the bevel may or may not exist.
TEST(Topology, AFacetThatMayNotBeThereIsNamed) {
    const Solid mesh = bevelled(1.9);
    std::vector<Reading> readings = readings_without_bevel(mesh);
    readings.push_back(reading(ReadingKind::table_width, {}, 2, 0.002));
    const FitResult result = fit_stone(stone_of(mesh), noisy(readings, 2));
    const ShapeFinding* facet = finding(result, ShapeFinding::Kind::facet_open);
    ASSERT_NE(facet, nullptr) << result.message;
    EXPECT_THAT(facet->facets, ::testing::ElementsAre("bevel"));
    EXPECT_THAT(facet->what, ::testing::HasSubstr("may not be there"));
}

// A reading places its plane 20 um outside the box, which leaves no room for the bevel.
TEST(Topology, AFacetWithoutRoomIsNamedAndGoesWhereThatIsAllowed) {
    const Solid mesh = bevelled(1.9);
    std::vector<Reading> readings = readings_without_bevel(mesh);
    readings.push_back(reading(ReadingKind::table_width, {}, 2, 0.002));
    Reading apart = reading(ReadingKind::distance, {}, 4 * std::sqrt(0.5) + 0.02, 0.002);
    apart.places = {Place{Place::Kind::facet, find_facet(mesh, "bevel"), -1, -1},
                    Place{Place::Kind::edge, find_facet(mesh, "X-"), find_facet(mesh, "B"), -1}};
    readings.push_back(apart);
    readings = noisy(readings, 2);
    const FitResult result = fit_stone(stone_of(mesh), readings);
    EXPECT_NE(result.status, FitStatus::converged) << result.message;
    EXPECT_THAT(result.message, ::testing::HasSubstr("bevel"));
    EXPECT_TRUE(result.checks.closed);
    FitOptions options;
    options.allow_topology = true;
    const FitResult changed = fit_stone(stone_of(mesh), readings, options);
    EXPECT_EQ(changed.status, FitStatus::converged) << changed.message;
    EXPECT_LT(find_facet(changed.solid, "bevel"), 0);
    EXPECT_EQ(changed.solid.facets.size(), 6u);
    EXPECT_THAT(find_faults(changed.solid), ::testing::IsEmpty());
    EXPECT_THAT(changed.log.changes,
                ::testing::Contains("facets removed, the readings leave them no room: bevel"));
    EXPECT_THAT(changed.log.changes, ::testing::Contains(::testing::HasSubstr("no longer apply")));
    EXPECT_EQ(changed.readings.size(), readings.size());
    EXPECT_TRUE(std::isnan(changed.readings.back().fitted));
}

TEST(Topology, AnEdgeShorterThanItsUncertaintyIsOpen) {
    const Solid truth = roof(1.002, 1);
    const FitResult result = fit_stone(standing(truth), plane_readings(truth, truth, 0.1, 0.01));
    const ShapeFinding* edge = finding(result, ShapeFinding::Kind::edge_open);
    ASSERT_NE(edge, nullptr) << result.message;
    EXPECT_THAT(std::vector<std::string>(edge->facets.begin(), edge->facets.begin() + 2),
                ::testing::UnorderedElementsAre("N", "S"));
    EXPECT_NEAR(edge->value, 0.004, 1e-6);
    EXPECT_THAT(edge->what, ::testing::HasSubstr("may have no length"));
}

TEST(Topology, ASoundStoneHasNothingToSay) {
    const Solid truth = brilliant();
    const FitResult result =
        fit_stone(stone_of(truth), noisy(plane_readings(truth, truth, 0.05, 0.005), 4));
    for (const ShapeFinding& f : result.findings.shapes) ADD_FAILURE() << f.what;
}

/// A prism of seven sides, two of them four degrees apart.
Solid prism() {
    std::vector<NamedPlane> planes{{"T", {{0, 0, 1}, 0.5}}, {"B", {{0, 0, -1}, 0.5}}};
    for (const double azimuth : {-2.0, 2.0, 60.0, 120.0, 180.0, 240.0, 300.0}) {
        planes.push_back({fmt::format("S{}", planes.size() - 1), {direction(90, azimuth), 1}});
    }
    return enclosed(planes);
}

// Widths and azimuths fix the sides' places but not how wide each one is. Azimuths that make two
// neighbours concave therefore leave no room for one of them.
TEST(Topology, FacetsThatComeDownToNothingAreNamedWhereTheStoneCannotBeBroughtToMeet) {
    const Solid mesh = prism();
    std::vector<Reading> readings = all_angles(mesh, radians(0.1), "T");
    for (Reading& r : readings) {
        if (r.kind != ReadingKind::azimuth) continue;
        if (r.facets[0] == find_facet(mesh, "S1")) r.value = radians(3);
        if (r.facets[0] == find_facet(mesh, "S2")) r.value = radians(-3);
    }
    for (int k = 0; k < 6; ++k) readings.push_back(width(mesh, 30 * k, 0.01));
    readings.push_back(depth(mesh, 0.01));
    const FitResult result = fit_stone(stone_of(mesh), readings);
    ASSERT_EQ(result.status, FitStatus::not_converged) << result.message;
    EXPECT_THAT(result.message, ::testing::HasSubstr("nothing is left of"));
    EXPECT_THAT(result.message, ::testing::AnyOf(::testing::HasSubstr("S1"),  //
                                                 ::testing::HasSubstr("S2")));
}

TEST(Topology, FacetsWithoutWidthAndEdgesBetweenFacetsOfOnePlaneAreFoundByName) {
    EXPECT_TRUE(degenerate_parts(prism()).facets.empty());
    EXPECT_TRUE(degenerate_parts(prism()).edges.empty());
    Solid flat = prism();
    flat.facets[std::size_t(find_facet(flat, "S1"))].plane.normal =
        direction(90, 2 - 0.0005);  // S2 stands at 2
    const std::vector<std::string> edges = degenerate_parts(flat).edges;
    ASSERT_EQ(edges.size(), 1u);
    EXPECT_THAT(edges[0], ::testing::AnyOf("S1|S2", "S2|S1"));
    // A cube whose top is pressed down to just above its bottom: its four sides become slivers.
    Solid thin = cube();
    for (Vec3& v : thin.vertices) v.z *= 1e-6;
    EXPECT_THAT(degenerate_parts(thin).facets,
                ::testing::UnorderedElementsAre("X+", "X-", "Y+", "Y-"));
}

}  // namespace
}  // namespace culet
