// Meets that contradict the readings, and how releasing them splits them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "stone/cuts/cuts.h"
#include "stone/solid/checks.h"
#include "tests/fit/test_stones.h"

namespace culet {
namespace {

using namespace test;

/// A brilliant with the tip of lower half k raised by `up[k]`: all meets are exact but the culet,
/// which the mains through the moved tips miss.
Solid with_loose_culet(const std::array<double, 8>& up) {
    const BrilliantSize size;
    const double r = size.radius, low = -2 * size.girdle, step = std::numbers::pi / 4;
    const auto at = [](double radius, double azimuth, double z) {
        return Vec3{radius * std::cos(azimuth), radius * std::sin(azimuth), z};
    };
    const double reach = (1 - size.lower) * r;
    std::vector<Vec3> tips;
    for (std::size_t k = 0; k < 8; ++k) {
        tips.push_back(at(
            reach, (double(k) + 0.5) * step,
            low + up[k] - (r - reach * std::cos(step / 2)) * std::tan(radians(size.pavilion_deg))));
    }
    const auto outwards = [](const std::string& name, const Vec3& a, const Vec3& b, const Vec3& c) {
        Vec3 n = glm::cross(b - a, c - a);
        return through(name, n.z > 0 ? -n : n, a);
    };
    std::vector<NamedPlane> planes;
    for (const Facet& f : brilliant(size).facets) {
        const int number = f.name.size() > 1 ? std::stoi(f.name.substr(1)) - 1 : 0;
        if (f.name[0] == 'P') {
            const std::size_t k = std::size_t(number);
            planes.push_back(
                outwards(f.name, at(r, number * step, low), tips[(k + 7) % 8], tips[k]));
        } else if (f.name[0] == 'L') {
            const double end = (number / 2 + number % 2) * step, middle = (number / 2 + 0.5) * step;
            planes.push_back(outwards(f.name, at(r, end, low), at(r, middle, low),
                                      tips[std::size_t(number / 2)]));
        } else {
            planes.push_back({f.name, f.plane});
        }
    }
    return enclosed(planes);
}

std::vector<std::string> sorted(std::vector<std::string> names) {
    std::sort(names.begin(), names.end());
    return names;
}

const MeetFinding& meet_of(const FitResult& result, const std::vector<std::string>& names) {
    for (const MeetFinding& m : result.findings.meets) {
        if (sorted(m.facets) == sorted(names)) return m;
    }
    throw std::runtime_error("no such meet");
}

const std::vector<std::string> k_culet{"P1", "P2", "P3", "P4", "P5", "P6", "P7", "P8"};

// None is reported where there are no misses: each of 20 stones is tested at the 0.1 % level as a
// whole.
TEST(Meets, OfASoundStoneAreNotAccused) {
    const Solid truth = brilliant();
    const std::vector<Reading> readings = plane_readings(truth, truth, 0.05, 0.005);
    double p_sum = 0;
    int accused = 0, count = 0;
    for (unsigned seed = 1; seed <= 10; ++seed) {
        const FitResult result = fit_stone(stone_of(truth), noisy(readings, seed));
        EXPECT_EQ(result.findings.meets.size(), 57u);
        for (const MeetFinding& m : result.findings.meets) {
            accused += m.contradicted ? 1 : 0;
            p_sum += m.p;
            ++count;
            EXPECT_GT(m.tested, 0);
        }
    }
    EXPECT_EQ(accused, 0);
    // p is uniform: its mean is 1/2, with a standard error of 1/sqrt(12 n) if the tests are
    // independent.
    EXPECT_NEAR(p_sum / count, 0.5, 6 / std::sqrt(12.0 * count));
}

// Mains miss the culet by tens of micrometres and were read to 5 um and 0.05 degrees: the report
// names that meet alone, with its miss.
TEST(Meets, ACuletThatMissesIsNamed) {
    const Solid design = brilliant(),
                truth = with_loose_culet({0.02, -0.01, 0.015, 0.0, -0.02, 0.01, 0.005, -0.015});
    ASSERT_EQ(truth.facets.size(), design.facets.size());
    const std::vector<Reading> readings = plane_readings(design, truth, 0.05, 0.005);
    const FitResult result = fit_stone(stone_of(design), noisy(readings, 2));
    EXPECT_EQ(result.status, FitStatus::contradictory) << result.message;
    const MeetFinding& culet = meet_of(result, k_culet);
    EXPECT_TRUE(culet.contradicted);
    EXPECT_THAT(culet.advice, ::testing::HasSubstr("release it"));
    EXPECT_LT(culet.p, 1e-6);
}

// A released culet splits into the corners and small edges that the planes enclose (exact
// half-space intersection of the true planes: 5 more corners). All names stay, and no contradiction
// remains.
TEST(Meets, AReleasedCuletComesApart) {
    const Solid design = brilliant(),
                truth = with_loose_culet({0.02, -0.01, 0.015, 0.0, -0.02, 0.01, 0.005, -0.015});
    ASSERT_EQ(truth.vertices.size(), design.vertices.size() + 5);
    std::vector<Reading> readings = noisy(plane_readings(design, truth, 0.02, 0.002), 2);
    Reading meet = reading(ReadingKind::meet, {}, 0, 0);
    for (const std::string& name : k_culet) meet.facets.push_back(find_facet(design, name));
    meet.released = true;
    readings.push_back(meet);
    const FitResult result = fit_stone(stone_of(design), readings);
    EXPECT_EQ(result.status, FitStatus::converged) << result.message;
    EXPECT_TRUE(result.checks.closed && result.checks.convex);
    EXPECT_THAT(find_faults(result.solid), ::testing::IsEmpty());
    EXPECT_EQ(result.solid.facets.size(), design.facets.size());
    EXPECT_EQ(result.solid.vertices.size(), truth.vertices.size());
    for (const Facet& f : design.facets) EXPECT_GE(find_facet(result.solid, f.name), 0) << f.name;
    const MeetFinding& culet = meet_of(result, k_culet);
    EXPECT_EQ(culet.how, "released");
    EXPECT_LT(culet.p, 1e-6);
    EXPECT_GT(culet.miss, 0.002);
}

// The same without naming the meet: if allowed to, the fit releases what the readings contradict,
// reports it, and ends where all readings agree.
TEST(Meets, AContradictedCuletComesApartWhereThatIsAllowed) {
    const Solid design = brilliant(),
                truth = with_loose_culet({0.02, -0.01, 0.015, 0.0, -0.02, 0.01, 0.005, -0.015});
    FitOptions options;
    options.allow_topology = true;
    const FitResult result =
        fit_stone(stone_of(design), noisy(plane_readings(design, truth, 0.02, 0.002), 2), options);
    EXPECT_EQ(result.status, FitStatus::converged) << result.message;
    EXPECT_EQ(result.solid.vertices.size(), truth.vertices.size());
    EXPECT_THAT(find_faults(result.solid), ::testing::IsEmpty());
    EXPECT_THAT(result.log.changes,
                ::testing::Contains(::testing::AllOf(::testing::HasSubstr("came apart"),
                                                     ::testing::HasSubstr("P1, P8, P7"))));
    EXPECT_THAT(result.log.changes, ::testing::Contains(::testing::HasSubstr("edges new")));
}

}  // namespace
}  // namespace culet
