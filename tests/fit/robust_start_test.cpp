// How far from the stone a fit may start: a quick form of bench/fit_bench.cpp. Expectation: the fit
// that starts at the truth.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "fit/mesh/repair.h"
#include "fit/model/canonical.h"
#include "fit/starts/starts.h"
#include "stone/solid/checks.h"
#include "tests/fit/fit_trials.h"
#include "tests/fit/test_stones.h"

namespace culet {
namespace {

using namespace bench;

void expect_found(const Truth& truth, const Stone& mesh, const std::string& what) {
    const auto readings = read_by_instruments(truth, 17);
    const Trial reference = fit_mesh(truth.stone, readings);
    const Trial trial = fit_mesh(mesh, readings);
    EXPECT_TRUE(succeeds(truth.stone, trial, reference))
        << what << ": chi2 " << trial.result.statistics.chi2 << " against "
        << reference.result.statistics.chi2 << "; " << trial.result.message << trial.refusal;
}

TEST(RobustStart, FromNoiseOfAFifthOfTheDiameter) {
    for (unsigned seed = 1; seed <= 2; ++seed) {
        for (const bool symmetric : {true, false}) {
            for (const TruthKind kind : {TruthKind::round, TruthKind::step}) {
                const Truth truth = make_truth(kind, symmetric, seed);
                expect_found(truth, noisy_mesh(truth.stone, 0.2, seed + 50),
                             std::string(name_of(kind)) + " " + std::to_string(seed));
            }
        }
    }
}

TEST(RobustStart, FromWrongProportions) {
    const Truth truth = make_truth(TruthKind::round, true, 4);
    expect_found(truth, wrongly_drawn(truth.stone, 0.2, 9), "wrongly drawn");
}

// From this mesh the first starts end with chi-squares of a million.
TEST(RobustStart, WhereTheFirstStartsLeadToNoStoneALaterOneDoes) {
    const Truth truth = make_truth(TruthKind::step, false, 186);
    const auto readings = read_by_instruments(truth, 1186);
    const Trial reference = fit_mesh(truth.stone, readings);
    const Trial trial = fit_mesh(wrongly_drawn(truth.stone, 0.2, 186), readings);
    EXPECT_TRUE(succeeds(truth.stone, trial, reference)) << trial.result.message;
}

// Without azimuth readings only widths determine the turn of a nearly round stone about the
// vertical, and chi-square has a local minimum at each turn by one girdle corner. These meshes lead
// to the wrong minima.
TEST(RobustStart, OfTurnsThatOnlyCalipersFeelTheBestIsFound) {
    struct Case {
        unsigned seed;
        double noise;
    };
    for (const auto& [seed, noise] : {Case{4, 0.1}, Case{16, 0.1}, Case{27, 0.2}}) {
        const Truth truth = make_truth(TruthKind::trillion, false, seed);
        const auto readings = read_by_instruments(truth, 1000 + seed);
        const Trial reference = fit_mesh(truth.stone, readings);
        const Trial trial = fit_mesh(noisy_mesh(truth.stone, noise, 77 * seed + 5), readings);
        EXPECT_TRUE(is_valid(truth.stone, trial.result)) << seed;
        EXPECT_LT(trial.result.statistics.chi2, reference.result.statistics.chi2 + 0.1) << seed;
    }
}

// Girdle facets are within half a degree of upright, and only their neighbours tell which lean in
// and which out. Here several must be flipped together; flipping one or two at a time ends at a
// chi-square that is 3.7 larger.
TEST(RobustStart, LeaningsThatGainTogetherOnlyAreFound) {
    const Truth truth = make_truth(TruthKind::round, false, 81);
    const auto readings = read_by_instruments(truth, 1081);
    const Trial reference = fit_mesh(truth.stone, readings);
    const Trial trial = fit_mesh(noisy_mesh(truth.stone, 0.1, 77 * 81 + 5), readings);
    EXPECT_TRUE(is_valid(truth.stone, trial.result));
    // Jaws on other corners change chi-square by less than 1.
    EXPECT_LT(trial.result.statistics.chi2, reference.result.statistics.chi2 + 1);
}

// Optima that earlier searches missed, from meshes drawn wrong by 20 %: their starts were all
// alike, or built on what an earlier start had found. The reference starts at the truth.
TEST(RobustStart, LesserEndsAreLeft) {
    struct Case {
        TruthKind kind;
        bool symmetric;
        unsigned seed;
    };
    for (const auto& [kind, symmetric, seed] :
         {Case{TruthKind::step, true, 29}, Case{TruthKind::pear, false, 109}}) {
        const Truth truth = make_truth(kind, symmetric, seed);
        const auto readings = read_by_instruments(truth, 1000 + seed);
        const Trial reference = fit_mesh(truth.stone, readings);
        const Trial trial = fit_mesh(wrongly_drawn(truth.stone, 0.2, 77 * seed + 5), readings);
        EXPECT_TRUE(is_valid(truth.stone, trial.result)) << seed;
        EXPECT_LT(trial.result.statistics.chi2, reference.result.statistics.chi2 + 0.1) << seed;
    }
}

// The sides of a plate lean by ten degrees and are as high as a twentieth of its half width:
// corners off by a third of that tilt them by more than they lean. Their length does not help.
TEST(RobustStart, SlenderFacetsDoNotSayWhichWayTheyLean) {
    Stone plate;
    plate.solid = test::enclosed({{"T", {{0, 0, 1}, 0.05}},
                                  {"X+", {test::direction(80, 0), 1}},
                                  {"Y+", {test::direction(80, 90, true), 1}},
                                  {"X-", {test::direction(80, 180), 1}},
                                  {"Y-", {test::direction(80, 270, true), 1}},
                                  {"B", {{0, 0, -1}, 0.05}}});
    plate.up_facet = "T";
    const double noise = 0.033 / diameter(plate.solid);
    std::vector<WrittenReading> written;
    for (const char* side : {"X+", "Y+", "X-", "Y-"}) {
        WrittenReading inclination;
        inclination.kind = "inclination";
        inclination.of = {side};
        inclination.value = 80;
        inclination.sigma = 0.1;
        written.push_back(std::move(inclination));
    }
    for (unsigned seed = 1; seed <= 50; ++seed) {
        const Stone mesh = noisy_mesh(plate, noise, seed);
        const FitModel model(mesh, bind_readings(written, mesh), {});
        const std::optional<Start> start = Starts(model).next();
        ASSERT_TRUE(start) << seed;
        for (std::size_t f = 0; f < plate.solid.facets.size(); ++f) {
            if (start->sides.empty() || start->sides[f] == 0) continue;
            EXPECT_GT(start->sides[f] * plate.solid.facets[f].plane.normal.z, 0)
                << plate.solid.facets[f].name << ", seed " << seed;
        }
    }
}

TEST(RobustStart, KicksBreakNothing) {
    const Truth truth = make_truth(TruthKind::step, false, 3);
    for (unsigned seed = 1; seed <= 8; ++seed) {
        expect_found(truth, kicked_mesh(truth.stone, seed), "kick " + std::to_string(seed));
    }
}

// An exact symmetry holds to rounding: every facet has its image among the others.
TEST(RobustStart, ExactSymmetryHoldsToRounding) {
    const Truth truth = make_truth(TruthKind::round, true, 5);
    const Trial trial = fit_mesh(noisy_mesh(truth.stone, 0.1, 5), read_by_instruments(truth, 8));
    ASSERT_TRUE(is_valid(truth.stone, trial.result)) << trial.result.message;
    const Solid& solid = trial.result.solid;
    Vec3 axis(0);
    for (const Facet& f : solid.facets) {
        if (f.name[0] == 'P') axis += f.plane.normal;
    }
    ASSERT_LT(std::hypot(axis.x, axis.y), 1e-12);
    const double turn = radians(45), c = std::cos(turn), s = std::sin(turn);
    for (const Facet& f : solid.facets) {
        const Vec3& n = f.plane.normal;
        const Vec3 image{c * n.x - s * n.y, s * n.x + c * n.y, n.z};
        double nearest = 1;
        for (const Facet& g : solid.facets) {
            nearest = std::min(nearest, glm::length(image - g.plane.normal));
        }
        EXPECT_LT(nearest, 1e-12) << f.name;
    }
}

// By definition, planes pass through their points, edges touch the unit sphere, and the mean of the
// touching points is the centre (Springborn 2005).
TEST(Canonical, EdgesTouchTheSphere) {
    for (const TruthKind kind : {TruthKind::round, TruthKind::pear}) {
        const Solid solid = make_truth(kind, false, 2).stone.solid;
        const HalfEdges half = half_edges(solid);
        const auto shape = canonical_polyhedron(solid, half);
        ASSERT_TRUE(shape);
        Vec3 mean(0);
        for (const Edge& e : half.edges) {
            const Vec3 a = shape->points[e.from], b = shape->points[e.to];
            const Vec3 along = glm::normalize(b - a);
            const Vec3 foot = a - glm::dot(a, along) * along;
            EXPECT_NEAR(glm::length(foot), 1, 1e-9);
            mean += foot / double(half.edges.size());
        }
        EXPECT_LT(glm::length(mean), 1e-9);
        for (std::size_t f = 0; f < solid.facets.size(); ++f) {
            for (int corner : solid.facets[f].corners) {
                EXPECT_NEAR(glm::dot(shape->normals[f], shape->points[corner]), shape->offsets[f],
                            1e-9);
            }
        }
    }
}

// Every facet has corners of its own, each a little off.
TEST(Mending, WeldsPrivateCorners) {
    const Truth truth = make_truth(TruthKind::round, false, 6);
    const Stone jittered = noisy_mesh(truth.stone, 0, 1);
    Stone split = jittered;
    split.solid.vertices.clear();
    unsigned count = 0;
    for (Facet& f : split.solid.facets) {
        for (int& corner : f.corners) {
            const double off = 0.01 * std::sin(double(++count));
            split.solid.vertices.push_back(jittered.solid.vertices[corner] +
                                           Vec3{off, -off, 0.5 * off});
            corner = static_cast<int>(split.solid.vertices.size()) - 1;
        }
    }
    EXPECT_FALSE(is_closed(split.solid));
    const Repaired result = repaired(split);
    EXPECT_EQ(result.stone.solid.vertices.size(), truth.stone.solid.vertices.size());
    EXPECT_EQ(result.notes.size(), 1u);
    expect_found(truth, split, "private corners");
}

// Users need not repair the mesh first; the result says what was repaired.
TEST(Mending, IsDoneByTheFit) {
    const Truth truth = make_truth(TruthKind::round, false, 7);
    Stone inside_out = truth.stone;
    for (Facet& f : inside_out.solid.facets) std::reverse(f.corners.begin(), f.corners.end());
    const FitResult result = fit_stone(fit_input(inside_out, read_by_instruments(truth, 17)));
    EXPECT_EQ(result.status, FitStatus::converged) << result.message;
    EXPECT_THAT(result.log.notes, ::testing::Contains(::testing::HasSubstr("inside out")));
    ASSERT_FALSE(result.log.changed.empty());
    EXPECT_EQ(result.log.changed[0].what, "facets turned round");
    EXPECT_EQ(result.log.changed[0].before, double(truth.stone.solid.facets.size()));
    EXPECT_EQ(result.log.changed[0].after, 0);
}

TEST(Mending, TurnsASurfaceRound) {
    const Truth truth = make_truth(TruthKind::round, false, 7);
    Stone inside_out = truth.stone;
    for (Facet& f : inside_out.solid.facets) std::reverse(f.corners.begin(), f.corners.end());
    EXPECT_GT(volume(repaired(inside_out).stone.solid), 0);
    expect_found(truth, inside_out, "inside out");
}

// Facets with four or more corners are drawn as fans of triangles that bear the facet's name, with
// the suffixes an OBJ file gives repeated names.
TEST(Mending, JoinsPiecesOfAFacet) {
    const Truth truth = make_truth(TruthKind::step, false, 8);
    Stone pieces = truth.stone;
    pieces.solid.facets.clear();
    for (const Facet& f : truth.stone.solid.facets) {
        for (std::size_t k = 1; k + 1 < f.corners.size(); ++k) {
            Facet piece = f;
            piece.corners = {f.corners[0], f.corners[k], f.corners[k + 1]};
            if (k > 1) piece.name += "." + std::to_string(k - 1);
            pieces.solid.facets.push_back(piece);
        }
    }
    const Repaired result = repaired(pieces);
    EXPECT_EQ(result.stone.solid.facets.size(), truth.stone.solid.facets.size());
    expect_found(truth, pieces, "pieces");
}

TEST(Mending, LeavesASoundMeshAsItIs) {
    const Truth truth = make_truth(TruthKind::pear, false, 1);
    const Repaired result = repaired(truth.stone);
    EXPECT_THAT(result.notes, ::testing::IsEmpty());
    EXPECT_EQ(result.stone.solid.vertices, truth.stone.solid.vertices);
}

// Only the shape counts: a mesh in inches is scaled for lengths in millimetres, and the report says
// so.
TEST(RobustStart, FromAnotherUnit) {
    const Truth truth = make_truth(TruthKind::round, false, 9);
    for (const double factor : {1 / 25.4, 10.0, 1000.0}) {
        Stone mesh = truth.stone;
        for (Vec3& v : mesh.solid.vertices) v *= factor;
        for (Facet& f : mesh.solid.facets) f.plane.offset *= factor;
        const Trial trial = fit_mesh(mesh, read_by_instruments(truth, 3));
        EXPECT_EQ(trial.refusal, "");
        EXPECT_TRUE(is_valid(truth.stone, trial.result));
        EXPECT_THAT(trial.result.message, ::testing::HasSubstr("drawn in another unit")) << factor;
    }
}

TEST(RobustStart, FromAnEarlierResultUnderExactSymmetry) {
    // The mesh is off, and so is the pose of the result: the symmetry's axis and mirrors are not
    // those of the readings' frame.
    for (const TruthKind kind : {TruthKind::round, TruthKind::step}) {
        const Truth truth = make_truth(kind, true, 2);
        auto readings = read_by_instruments(truth, 11);
        const Stone mesh = noisy_mesh(truth.stone, 0.01, 4);
        const Trial first = fit_mesh(mesh, readings);
        FitOptions options;
        options.start = first.result.solid;
        const auto edited = std::find_if(readings.begin(), readings.end(),
                                         [](const WrittenReading& r) { return r.kind == "edge"; });
        *edited->value += 0.01;
        const Trial again = fit_mesh(mesh, readings, options);
        EXPECT_EQ(again.result.log.start, "earlier result");
        // The same optimum as without the earlier result.
        EXPECT_TRUE(succeeds(truth.stone, again, fit_mesh(mesh, readings))) << again.result.message;
    }
}

}  // namespace
}  // namespace culet
