#include "fit/study/study.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

#include "stone/text/errors.h"
#include "tests/fit/test_stones.h"

namespace culet {
namespace {

using Json = nlohmann::json;

// Thirteen facets: table, four crown, four girdle, and four pavilion facets that meet in a point or
// a keel. They are not at right angles, so that nothing holds by symmetry.
Solid small_stone(bool keel) {
    std::vector<NamedPlane> planes{{"T", {{0, 0, 1}, 1}}};
    for (int k = 0; k < 4; ++k) {
        const double a = 90.0 * k;
        planes.push_back({fmt::format("C{}", k + 1), {test::direction(40 + k, a + k), 1.9}});
        planes.push_back({fmt::format("G{}", k + 1), {test::direction(80, a + 2), 2 + 0.05 * k}});
        planes.push_back({fmt::format("P{}", k + 1), {test::direction(44 + k, a - k, true), 1.5}});
    }
    // The four planes of the pavilion through one point.
    for (NamedPlane& plane : planes) {
        if (plane.name[0] == 'P') {
            const bool side = keel && (plane.name == "P1" || plane.name == "P3");
            plane.plane.offset =
                glm::dot(plane.plane.normal, Vec3{0.02, -0.01, -2.1}) + (side ? 0.3 : 0);
        }
    }
    return test::enclosed(planes);
}

struct Case {
    Stone stone;
    std::vector<Reading> readings;

    explicit Case(bool keel = false) : stone(test::stone_of(small_stone(keel))) {
        const Solid& solid = stone.solid;
        std::vector<Reading> all = test::all_angles(solid, radians(0.1), "T");
        for (const double azimuth : {0.0, 45.0, 90.0}) {
            all.push_back(test::width(solid, azimuth, 0.01));
        }
        all.push_back(test::depth(solid, 0.01));
        for (Reading& edge : test::all_edges(solid, 0.01)) all.push_back(std::move(edge));
        readings = test::noisy(std::move(all), 5);
    }
};

StudyOptions without_limit(int draws, std::uint64_t seed = 1) {
    StudyOptions options;
    options.draws = draws;
    options.seed = seed;
    options.budget_seconds = 0;
    return options;
}

Json without_times(const Study& study) {
    Json json = Json::parse(study_json(study));
    json.erase("seconds");
    for (Json& row : json["settings"]) {
        for (const char* key : {"seconds", "seconds_low", "seconds_high"}) row.erase(key);
    }
    return json;
}

TEST(Study, HasARowForEachWayOfFitting) {
    const Case c(true);
    const Study study = study_fit(c.stone, c.readings, without_limit(2));
    ASSERT_EQ(study.status, FitStatus::converged) << study.message;
    const Json json = Json::parse(study_json(study));
    EXPECT_EQ(json["schema"], 1);
    EXPECT_EQ(json["kind"], "fit");
    EXPECT_EQ(json["facets"], 13);
    std::map<std::string, int> sweeps, asked;
    for (const Json& row : json["settings"]) {
        ++sweeps[row["sweep"]];
        asked[row["sweep"]] += row["as_asked"].get<bool>();
        EXPECT_EQ(row["fits"], 2);
        EXPECT_LE(row["settled"], row["sound"]);
        EXPECT_LE(row["seconds_low"], row["seconds"]);
        EXPECT_LE(row["seconds"], row["seconds_high"]);
    }
    EXPECT_EQ(sweeps["meets"], 3);
    EXPECT_GE(sweeps["start"], 3);
    EXPECT_GE(sweeps["iterations"], 3);
    for (const auto& [sweep, count] : asked) EXPECT_EQ(count, 1) << sweep;
    // The requested setting is valid, and by definition its own best.
    for (const Json& row : json["settings"]) {
        if (!row["as_asked"] || row["sweep"] == "starts") continue;
        EXPECT_EQ(row["sound"], 2);
        if (row["sweep"] != "meets") {
            EXPECT_EQ(row["best"], 2);
        }
        // The error has the size of the readings' own (0.1 degrees).
        EXPECT_GT(row["angle_error"], 0.02);
        EXPECT_LT(row["angle_error"], 0.2);
    }
    // As many columns as keys, as many lines as rows.
    std::istringstream csv(study_time_csv(study));
    std::size_t lines = 0;
    for (std::string line; std::getline(csv, line); ++lines) {
        EXPECT_EQ(std::count(line.begin(), line.end(), ','), 12);
    }
    EXPECT_EQ(lines, json["settings"].size() + 1);
}

// Information is a sum over readings (Fisher): removing some can only raise the limit. A convex
// polyhedron of E edges has E + 6 parameters (Steinitz), six of them its pose. Readings see E and
// where azimuths begin, so at least E + 1 readings are needed.
TEST(Study, RaisesTheLimitAsReadingsGoUntilEachIsNeeded) {
    const Case c;
    StudyOptions options = without_limit(1);
    options.times = false;
    const Study study = study_fit(c.stone, c.readings, options);
    EXPECT_TRUE(study.settings.empty());
    ASSERT_GE(study.limits.size(), 3u) << study.limit_message;
    EXPECT_EQ(study.limits.front().readings, static_cast<int>(c.readings.size()));
    EXPECT_EQ(study.limits.front().share, 1);
    for (std::size_t i = 1; i < study.limits.size(); ++i) {
        const StudyLimit &before = study.limits[i - 1], &now = study.limits[i];
        EXPECT_LT(now.readings, before.readings);
        EXPECT_LT(now.dof, before.dof);
        EXPECT_GE(now.angle_limit, before.angle_limit * (1 - 1e-6));
        EXPECT_GE(now.offset_limit, before.offset_limit * (1 - 1e-6));
    }
    EXPECT_EQ(study.limits.back().readings, edge_count(c.stone.solid) + 1);
    EXPECT_NEAR(study.limits.back().dof, 0, 1e-3);
    EXPECT_NE(study.limit_message, "");
}

// Least squares with the right weights reaches the Cramer-Rao limit (Gauss-Markov) as far as the
// stone is linear over the size of the errors: the ratio is 1 within its own scatter.
TEST(Study, ComesToTheCramerRaoLimit) {
    const Case c;
    StudyOptions options = without_limit(30, 3);
    options.times = false;
    const Study study = study_fit(c.stone, c.readings, options);
    ASSERT_GE(study.limits.size(), 3u);
    for (const StudyLimit& row : study.limits) {
        EXPECT_EQ(row.draws, 30);
        EXPECT_EQ(row.failed, 0);
        EXPECT_GT(row.ratio_sigma, 0.005);
        EXPECT_LT(row.ratio_sigma, 0.15);
        EXPECT_NEAR(row.ratio, 1, 4 * row.ratio_sigma) << row.readings << " readings";
    }
    EXPECT_LT(study.limits.front().ratio, 1.05);
}

// The prior's mean is the truth in every draw, so errors would be below a limit that counts the
// prior. The limit must count readings alone.
TEST(Study, LimitCountsReadingsAlone) {
    const Case c;
    StudyOptions options = without_limit(1);
    options.times = false;
    const Study alone = study_fit(c.stone, c.readings, options);
    options.fit.prior.source = Prior::Source::catalogue;
    const Study beside_prior = study_fit(c.stone, c.readings, options);
    ASSERT_EQ(beside_prior.limits.size(), alone.limits.size());
    for (std::size_t i = 0; i < alone.limits.size(); ++i) {
        // The two fits end at the same stone, each to its own last digits.
        const auto &one = alone.limits[i], &other = beside_prior.limits[i];
        EXPECT_NEAR(other.angle_limit, one.angle_limit, 1e-9 * one.angle_limit) << i;
        EXPECT_NEAR(other.offset_limit, one.offset_limit, 1e-9 * one.offset_limit) << i;
    }
}

TEST(Study, IsTheSameEachTimeApartFromTheTimes) {
    const Case c(true);
    const Json first = without_times(study_fit(c.stone, c.readings, without_limit(1, 9)));
    EXPECT_EQ(first, without_times(study_fit(c.stone, c.readings, without_limit(1, 9))));
    EXPECT_NE(first, without_times(study_fit(c.stone, c.readings, without_limit(1, 10))));
}

// A time budget cuts draws off; the remaining ones equal the first of a longer study.
TEST(Study, EndsWhenItsBudgetIsSpent) {
    const Case c;
    StudyOptions options = without_limit(3);
    options.budget_seconds = 1e-6;
    const Study cut = study_fit(c.stone, c.readings, options);
    EXPECT_EQ(cut.status, FitStatus::converged);
    EXPECT_TRUE(cut.settings.empty());
    EXPECT_FALSE(cut.left_out.empty());
    EXPECT_EQ(Json::parse(study_json(cut))["settings"].size(), 0u);
}

TEST(Study, MakesSoftMeetsAndSymmetriesExactForTheLimit) {
    Case c;
    StudyOptions options = without_limit(1);
    options.fit.meets = MeetTreatment::soft;
    options.fit.meet_sigma = 0.005;
    options.times = false;
    const Study study = study_fit(c.stone, c.readings, options);
    EXPECT_TRUE(study.limit_made_exact);
    EXPECT_FALSE(study.limits.empty()) << study.limit_message;
}

TEST(Study, OfReadingsThatLeaveTheStoneOpenHasNoLimit) {
    Case c;
    c.readings.resize(10);
    StudyOptions options = without_limit(1);
    options.times = false;
    const Study study = study_fit(c.stone, c.readings, options);
    EXPECT_EQ(study.status, FitStatus::undetermined);
    EXPECT_TRUE(study.limits.empty());
    EXPECT_NE(study.limit_message.find("do not determine"), std::string::npos)
        << study.limit_message;
    EXPECT_FALSE(study.usable());
}

TEST(Study, StopsWhenItIsToldTo) {
    const Case c(true);
    int calls = 0;
    EXPECT_THROW(study_fit(c.stone, c.readings, without_limit(3),
                           [&](double fraction) {
                               EXPECT_GE(fraction, 0);
                               EXPECT_LE(fraction, 1);
                               return ++calls < 40;
                           }),
                 Interrupted);
}

}  // namespace
}  // namespace culet
