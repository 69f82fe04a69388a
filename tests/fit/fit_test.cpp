#include "fit/fit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <nlohmann/json.hpp>

#include "stone/cuts/cuts.h"
#include "stone/solid/checks.h"
#include "stone/text/errors.h"
#include "tests/fit/test_stones.h"

namespace culet {
namespace {

using namespace test;

void expect_sound(const FitResult& result) {
    EXPECT_TRUE(result.checks.closed);
    EXPECT_TRUE(result.checks.convex);
    EXPECT_LT(result.checks.planarity_max, 1e-12 * diameter(result.solid));
    EXPECT_THAT(find_faults(result.solid), ::testing::IsEmpty());
}

TEST(TestStones, BrilliantHasTheKnownCounts) {
    const Solid solid = brilliant();
    EXPECT_EQ(solid.facets.size(), 73u);
    EXPECT_EQ(solid.vertices.size(), 57u);
    EXPECT_EQ(edge_count(solid), 128);
    EXPECT_TRUE(is_closed(solid));
    EXPECT_TRUE(is_convex(solid));
}

TEST(Fit, RecoversAShakenBrilliant) {
    const Solid truth = brilliant();
    std::vector<Reading> readings = all_angles(truth, radians(0.1), "T");
    for (const Reading& r : all_edges(truth, 0.01)) readings.push_back(r);
    readings.push_back(depth(truth, 0.01));
    for (int k = 0; k < 8; ++k) readings.push_back(width(truth, 22.5 * k, 0.01));
    for (const double noise : {0.01, 0.1, 0.2}) {
        const FitResult result = fit_stone(stone_of(shaken(truth, noise, 3)), readings);
        EXPECT_EQ(result.status, FitStatus::converged) << noise << ": " << result.message;
        EXPECT_LT(result.statistics.chi2, 1e-6) << noise;
        expect_sound(result);
        for (std::size_t f = 0; f < truth.facets.size(); ++f) {
            EXPECT_NEAR(area(result.solid, result.solid.facets[f]), area(truth, truth.facets[f]),
                        1e-6)
                << truth.facets[f].name << " at " << noise;
        }
    }
}

std::vector<Reading> every_reading(const Solid& truth) {
    std::vector<Reading> readings = all_angles(truth, radians(0.1), "T");
    for (const Reading& r : all_edges(truth, 0.01)) readings.push_back(r);
    readings.push_back(depth(truth, 0.01));
    return readings;
}

// Chi-square has mean dof and variance 2 dof, so the mean of chi2/dof over 6 fits has a standard
// deviation of sqrt(2 / (6 dof)).
TEST(Fit, ChiSquareIsRightOnAverage) {
    const Solid truth = brilliant();
    const std::vector<Reading> readings = every_reading(truth);
    double ratio = 0, dof = 0;
    const int fits = 6;
    for (unsigned seed = 1; seed <= fits; ++seed) {
        const FitResult result = fit_stone(stone_of(truth), noisy(readings, seed));
        EXPECT_EQ(result.status, FitStatus::converged) << seed << ": " << result.message;
        ratio += result.statistics.chi2 / result.statistics.dof / fits;
        dof = result.statistics.dof;
    }
    // Edges, angles and one depth. Unknowns: 128 + 6 (Steinitz: edges + 6), less 3 shifts and the
    // table's two tilts, which fix the frame.
    EXPECT_NEAR(dof, double(readings.size()) - (128 + 6 - 3 - 2), 1e-6);
    EXPECT_NEAR(ratio, 1, 4 * std::sqrt(2 / (fits * dof)));
}

// Errors of fitted planes, divided by their reported uncertainty, have unit standard deviation.
TEST(Fit, ReportedUncertaintiesAreHonest) {
    const Solid truth = brilliant();
    const std::vector<Reading> readings = every_reading(truth);
    double squares = 0, area_squares = 0;
    int count = 0;
    for (unsigned seed = 11; seed <= 14; ++seed) {
        const FitResult result = fit_stone(stone_of(truth), noisy(readings, seed));
        for (std::size_t f = 0; f < truth.facets.size(); ++f) {
            if (truth.facets[f].name == "T") continue;
            const double z = (result.facets[f].inclination -
                              inclination(truth.facets[f].plane.normal, {0, 0, 1})) /
                             result.facets[f].sigma_inclination;
            const double a = (result.facets[f].area - area(truth, truth.facets[f])) /
                             result.facets[f].sigma_area;
            // At 90 degrees the inclination has a sign ambiguity: leave the girdle out.
            if (truth.facets[f].name[0] == 'G') continue;
            squares += z * z;
            area_squares += a * a;
            ++count;
        }
    }
    EXPECT_NEAR(std::sqrt(squares / count), 1, 0.2);
    EXPECT_NEAR(std::sqrt(area_squares / count), 1, 0.2);
}

// The joint covariance must agree with each facet's sigmas: their squares are on its diagonal, and
// no correlation exceeds 1.
TEST(Fit, FacetCovarianceHasTheSigmasOnItsDiagonal) {
    const Solid truth = brilliant();
    const FitResult result = fit_stone(stone_of(truth), noisy(every_reading(truth), 5));
    const std::size_t size = 3 * result.facets.size();
    ASSERT_EQ(result.facet_covariance.size(), size * size);
    const auto at = [&](std::size_t i, std::size_t j) {
        return result.facet_covariance[i * size + j];
    };
    for (std::size_t f = 0; f < result.facets.size(); ++f) {
        const FittedFacet& facet = result.facets[f];
        const double azimuth = std::isfinite(facet.sigma_azimuth) ? facet.sigma_azimuth : 0;
        EXPECT_NEAR(std::sqrt(at(3 * f, 3 * f)), facet.sigma_inclination, 1e-9) << facet.name;
        EXPECT_NEAR(std::sqrt(at(3 * f + 1, 3 * f + 1)), azimuth, 1e-9) << facet.name;
        EXPECT_NEAR(std::sqrt(at(3 * f + 2, 3 * f + 2)), facet.sigma_offset, 1e-9) << facet.name;
    }
    double off_diagonal = 0;
    for (std::size_t i = 0; i < size; ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            EXPECT_EQ(at(i, j), at(j, i));
            const double most = std::sqrt(at(i, i) * at(j, j));
            EXPECT_LE(std::abs(at(i, j)), most * (1 + 1e-6) + 1e-15);
            if (most > 0) off_diagonal = std::max(off_diagonal, std::abs(at(i, j)) / most);
        }
    }
    EXPECT_GT(off_diagonal, 0.1) << "facets of one stone share corners: they are correlated";
}

TEST(Fit, FindsABlunderAndNamesIt) {
    const Solid truth = brilliant();
    std::vector<Reading> readings = noisy(every_reading(truth), 5);
    readings[20].value += 20 * readings[20].sigma;
    const FitResult result = fit_stone(stone_of(truth), readings);
    EXPECT_EQ(result.status, FitStatus::contradictory);
    EXPECT_THAT(result.findings.suspects, ::testing::Contains(readings[20].id));
    EXPECT_TRUE(result.readings[20].suspect);
    EXPECT_LE(result.findings.suspects.size(), 3u);
}

// Planes of a brilliant are turned by N(0, 0.3 degrees) about their facets' centres, so no stone
// with those angles has exact meets. The test computes the misses meet by meet (least squares, sum
// of squares over redundancy); the fit has angles and widths alone, and may choose the offsets that
// make the misses smaller.
TEST(Fit, EstimatesHowSoftMeetsMiss) {
    const Solid design = brilliant();
    std::vector<NamedPlane> planes;
    std::mt19937_64 random(3);
    std::normal_distribution<double> normal(0, radians(0.3));
    for (const Facet& f : design.facets) {
        const Vec3 turn{normal(random), normal(random), normal(random)};
        const Vec3 n =
            f.plane.normal + (f.name == "T" ? Vec3(0) : glm::cross(turn, f.plane.normal));
        planes.push_back(through(f.name, n, corner_mean(design, f)));
    }
    const Solid truth = intersect_half_spaces(planes).solid;
    ASSERT_EQ(truth.facets.size(), design.facets.size());
    double squares = 0, redundancy = 0;
    for (const std::vector<int>& meet : half_edges(design).facets_of_vertex) {
        glm::dmat3 normals(0.0);
        Vec3 right(0);
        for (int f : meet) {
            const Plane& plane = planes[std::size_t(f)].plane;
            normals += glm::outerProduct(plane.normal, plane.normal);
            right += plane.offset * plane.normal;
        }
        const Vec3 point = glm::inverse(normals) * right;
        for (int f : meet) {
            const double miss = height_above(planes[std::size_t(f)].plane, point);
            squares += miss * miss;
        }
        redundancy += double(meet.size()) - 3;
    }
    const double miss = std::sqrt(squares / redundancy);
    std::vector<Reading> readings = all_angles(truth, radians(0.02), "T");
    readings.push_back(depth(truth, 0.002));
    for (int k = 0; k < 16; ++k) readings.push_back(width(truth, 11.25 * k, 0.002));
    FitOptions options;
    options.meets = MeetTreatment::soft;
    const FitResult result = fit_stone(stone_of(design), readings, options);
    EXPECT_TRUE(result.statistics.meets.estimated);
    SCOPED_TRACE(fmt::format("{}: miss {:.3g}, sigma {:.3g} girdle {:.3g} chi2 {:.3g} dof {:.3g}",
                             result.message, miss, result.statistics.meets.sigma,
                             result.statistics.meets.girdle_sigma, result.statistics.chi2,
                             result.statistics.dof));
    EXPECT_GT(result.statistics.meets.sigma, 0.3 * miss);
    EXPECT_LT(result.statistics.meets.sigma, 1.5 * miss);
    EXPECT_TRUE(result.checks.closed && result.checks.convex) << result.message;
    EXPECT_EQ(result.solid.facets.size(), design.facets.size());
    EXPECT_LT(result.checks.planarity_max, 1e-9 * diameter(result.solid));
    const FitResult again = fit_stone(stone_of(design), readings, options);
    ASSERT_EQ(again.solid.vertices.size(), result.solid.vertices.size());
    for (std::size_t v = 0; v < again.solid.vertices.size(); ++v) {
        EXPECT_EQ(again.solid.vertices[v], result.solid.vertices[v]);
    }
}

// A box's lengths and angles are known by hand: each kind of reading alone must move it to its
// value.
class BoxReadings : public ::testing::Test {
protected:
    int facet(const char* name) const { return find_facet(box_, name); }
    FitResult fit(std::vector<Reading> readings) const {
        for (std::size_t i = 0; i < readings.size(); ++i) readings[i].id = fmt::format("b{}", i);
        return fit_stone(stone_of(box_), readings);
    }
    Reading exact(ReadingKind kind, std::vector<int> facets, double value) const {
        Reading r = reading(kind, std::move(facets), value, 0);
        r.exact = true;
        return r;
    }
    Solid box_ = cube();
};

TEST_F(BoxReadings, ExactLengthsHoldExactly) {
    std::vector<Reading> readings;
    readings.push_back(exact(ReadingKind::depth, {}, 2.3));
    Reading across = exact(ReadingKind::width, {}, 2.1);
    readings.push_back(across);
    across.azimuth = radians(90);
    across.value = 1.9;
    readings.push_back(across);
    for (const char* side : {"X+", "Y+", "X-", "Y-"}) {
        readings.push_back(exact(ReadingKind::inclination, {facet(side)}, radians(90)));
        readings.push_back(exact(ReadingKind::azimuth, {facet(side)},
                                 azimuth(box_.facets[facet(side)].plane.normal)));
    }
    readings.push_back(exact(ReadingKind::parallel, {facet("T"), facet("B")}, 0));
    const FitResult result = fit(readings);
    EXPECT_EQ(result.status, FitStatus::converged) << result.message;
    EXPECT_NEAR(volume(result.solid), 2.3 * 2.1 * 1.9, 1e-11);
    EXPECT_NEAR(width_along(result.solid, {0, 0, 1}), 2.3, 1e-12);
    for (const FittedReading& r : result.readings) EXPECT_LT(std::abs(r.residual), 1e-12) << r.id;
}

TEST_F(BoxReadings, EachKindReachesItsValue) {
    const double pi = std::numbers::pi;
    std::vector<Reading> kinds{
        reading(ReadingKind::inclination, {facet("X+")}, radians(85), 1e-4),
        reading(ReadingKind::dihedral, {facet("T"), facet("X+")}, radians(95), 1e-4),
        reading(ReadingKind::edge, {facet("T"), facet("X+")}, 2.1, 1e-4),
        reading(ReadingKind::depth, {}, 2.1, 1e-4),
        reading(ReadingKind::table_width, {}, 2.1, 1e-4),
        reading(ReadingKind::volume, {}, 8.4, 1e-4),
        reading(ReadingKind::weight, {}, 8.4 * 3.5 / 200, 1e-6)};
    Reading azimuth_read = reading(ReadingKind::azimuth, {facet("Y+")}, pi / 2 + 0.05, 1e-4);
    azimuth_read.datum = {Datum::Kind::facet, facet("X+")};
    kinds.push_back(azimuth_read);
    Reading spaced = reading(ReadingKind::distance, {}, 2.1, 1e-4);
    spaced.places = {Place{Place::Kind::facet, facet("X+"), -1, -1},
                     Place{Place::Kind::facet, facet("X-"), -1, -1}};
    kinds.push_back(spaced);
    Reading corner = spaced;
    corner.places = {Place{Place::Kind::facet, facet("B"), -1, -1},
                     Place{Place::Kind::vertex, -1, -1, box_.facets[0].corners[0]}};
    kinds.push_back(corner);
    for (const Reading& r : kinds) {
        const FitResult result = fit({r});
        EXPECT_NEAR(result.readings[0].fitted, r.value, 1e-3 * r.sigma + 1e-9) << name_of(r.kind);
        EXPECT_EQ(result.status, FitStatus::undetermined)
            << name_of(r.kind) << ": " << result.message;
        EXPECT_TRUE(result.checks.closed && result.checks.convex) << name_of(r.kind);
    }
}

TEST_F(BoxReadings, ExactRotationMakesAllSidesAlike) {
    box_ = shaken(box_, 0.03, 4);
    Reading turn = exact(ReadingKind::rotation, {}, 0);
    turn.order = 4;
    const FitResult result = fit({turn, depth(cube(), 0.01)});
    for (int k = 1; k < 5; ++k) {
        EXPECT_NEAR(result.facets[k].inclination, result.facets[1].inclination, 1e-12);
        EXPECT_NEAR(result.facets[k].area, result.facets[1].area, 1e-11);
    }
    EXPECT_LT(result.checks.planarity_max, 1e-12);
}

TEST_F(BoxReadings, ExactMirrorMakesPairsAlike) {
    box_ = shaken(box_, 0.03, 4);
    Reading mirror = exact(ReadingKind::mirror,
                           {facet("X+"), facet("X-"), facet("Y+"), facet("Y+"), facet("Y-"),
                            facet("Y-"), facet("B"), facet("B")},
                           0);
    const FitResult result = fit({mirror});
    EXPECT_NEAR(result.facets[1].inclination, result.facets[3].inclination, 1e-12);
    EXPECT_NEAR(result.facets[1].area, result.facets[3].area, 1e-11);
}

TEST_F(BoxReadings, NoReadingsAtAllLeaveTheMeshAndSaySo) {
    const FitResult result = fit({});
    EXPECT_EQ(result.status, FitStatus::undetermined) << result.message;
    // 12 edges + 6, less 3 shifts, the table's two tilts and the turn about the vertical.
    EXPECT_EQ(result.statistics.rank_defect, 12 + 6 - 6);
    EXPECT_NEAR(volume(result.solid), 8, 1e-6);
}

TEST_F(BoxReadings, OneReadingTakesOneFreedom) {
    EXPECT_EQ(fit({depth(box_, 0.01)}).statistics.rank_defect, 11);
}

TEST_F(BoxReadings, TheSameReadingTwiceIsNoContradiction) {
    const FitResult result = fit({depth(box_, 0.01), depth(box_, 0.01)});
    EXPECT_EQ(result.statistics.rank_defect, 11);
    EXPECT_NEAR(result.statistics.dof, 1, 1e-6);
    Reading r = exact(ReadingKind::depth, {}, 2.2);
    EXPECT_EQ(fit({r, r}).status, FitStatus::undetermined);
}

TEST_F(BoxReadings, ExactReadingsThatContradictAreAResult) {
    const FitResult result =
        fit({exact(ReadingKind::depth, {}, 2.2), exact(ReadingKind::depth, {}, 2.3)});
    EXPECT_EQ(result.status, FitStatus::contradictory);
    EXPECT_THAT(result.message, ::testing::HasSubstr("b0, b1"));
}

// The same stone in metres fits to the same shape: nothing depends on the unit.
TEST_F(BoxReadings, ScaleDoesNotMatter) {
    const FitResult mm = fit({depth(box_, 0.01), reading(ReadingKind::edge, {0, 1}, 2.2, 0.01)});
    for (Vec3& v : box_.vertices) v *= 1e-3;
    for (Facet& f : box_.facets) f.plane.offset *= 1e-3;
    const FitResult m = fit({depth(box_, 1e-5), reading(ReadingKind::edge, {0, 1}, 2.2e-3, 1e-5)});
    ASSERT_EQ(mm.solid.vertices.size(), m.solid.vertices.size());
    for (std::size_t v = 0; v < mm.solid.vertices.size(); ++v) {
        EXPECT_LT(glm::length(mm.solid.vertices[v] - 1e3 * m.solid.vertices[v]), 1e-6);
    }
}

TEST(Fit, AFacetThatWantsToVanishIsNamed) {
    // A bevel between T and X+. Depth readings push it outside the stone when meets are released.
    const double s = std::sqrt(0.5);
    const Solid solid = enclosed({{"T", {{0, 0, 1}, 1}},
                                  {"bevel", {{s, 0, s}, 1.9 * s}},
                                  {"X+", {{1, 0, 0}, 1}},
                                  {"Y+", {{0, 1, 0}, 1}},
                                  {"X-", {{-1, 0, 0}, 1}},
                                  {"Y-", {{0, -1, 0}, 1}},
                                  {"B", {{0, 0, -1}, 1}}});
    std::vector<Reading> readings = all_angles(solid, radians(0.01), "T");
    readings.push_back(reading(ReadingKind::depth, {}, 2, 0.001));
    Reading apart = reading(ReadingKind::distance, {}, 3.2, 1e-4);
    apart.places = {Place{Place::Kind::facet, 1, -1, -1},
                    Place{Place::Kind::edge, find_facet(solid, "X-"), find_facet(solid, "B"), -1}};
    readings.push_back(apart);
    readings.push_back(width(solid, 0, 0.001));
    const FitResult result = fit_stone(stone_of(solid), readings);
    EXPECT_NE(result.status, FitStatus::converged);
    EXPECT_FALSE(result.message.empty());
    EXPECT_TRUE(result.checks.closed);
}

TEST(Fit, RefusesAMeshThatIsNoSolid) {
    Solid open = cube();
    open.facets.pop_back();
    EXPECT_THROW(fit_stone(stone_of(open), {}), InputError);
    EXPECT_THROW(fit_stone(stone_of(Solid{}), {}), InputError);
    EXPECT_THROW(fit_stone(stone_of(cube(), "nothing"), {}), InputError);
}

TEST(Fit, StopsWhenAsked) {
    const Solid truth = brilliant();
    EXPECT_THROW(fit_stone(stone_of(truth), every_reading(truth), {}, [](double) { return false; }),
                 Interrupted);
}

TEST(FitReport, HasTheKeysThatOutsidersRelyOn) {
    const Solid truth = brilliant();
    const auto report =
        nlohmann::json::parse(fit_report(fit_stone(stone_of(truth), every_reading(truth))));
    for (const char* key : {"schema", "status", "facets", "readings", "undetermined", "suspects",
                            "planarity_max", "closed", "convex", "chi2", "dof", "iterations",
                            "seconds", "unit", "message", "meets", "areas"}) {
        EXPECT_TRUE(report.contains(key)) << key;
    }
    for (const char* key : {"name", "normal", "offset", "inclination", "azimuth",
                            "sigma_inclination", "sigma_azimuth", "sigma_offset"}) {
        EXPECT_TRUE(report["facets"][0].contains(key)) << key;
    }
    for (const char* key : {"id", "kind", "of", "value", "sigma", "fitted", "residual",
                            "normalized", "redundancy", "detectable", "suspect"}) {
        EXPECT_TRUE(report["readings"][0].contains(key)) << key;
    }
    EXPECT_EQ(report["facets"].size(), 73u);
}

}  // namespace
// Stones too large for dense algebra are analysed too. Expectation: two depths 8 sigma apart fit at
// their mean, 4 sigma from each, with a redundancy of one half each.
TEST(Fit, ALargeStoneHasUncertaintiesToo) {
    const Solid solid = make_cut("round-brilliant", {{"mains", 20}, {"girdle-segments", 6}});
    std::vector<Reading> readings{test::reading(ReadingKind::depth, {}, 4.02, 0.01),
                                  test::reading(ReadingKind::depth, {}, 4.10, 0.01)};
    readings[0].id = "r0";
    readings[1].id = "r1";
    const FitResult result = fit_stone(test::stone_of(solid), readings);
    EXPECT_EQ(result.status, FitStatus::contradictory);
    EXPECT_NEAR(result.readings[0].residual, 0.04, 1e-4);
    EXPECT_NEAR(result.readings[1].residual, -0.04, 1e-4);
    EXPECT_NEAR(result.readings[0].redundancy, 0.5, 1e-3);
    EXPECT_NEAR(result.statistics.dof, 1, 2e-3);
    // Edges + 6, less 3 shifts, the table's tilts, the turn about the vertical, and the depth.
    EXPECT_EQ(result.statistics.rank_defect, edge_count(solid) - 1);
    for (const FittedFacet& f : result.facets) EXPECT_GT(f.sigma_offset, 0) << f.name;
}

}  // namespace culet
