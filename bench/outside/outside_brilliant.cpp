// The sample real-brilliant, fitted to its rounded readings, against the unrounded planes of the
// scan that they come from: polyhedron.dat of stone "1_GIA" in
// ilya-palachev/polyhedra-correction-library.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "bench/outside/outside_folder.h"
#include "fit/fit.h"
#include "stone/solid/checks.h"
#include "stone/stone_io.h"
#include "tests/scanned_solid.h"

namespace culet {
namespace {

// Levels the table by the shortest turn (Rodrigues).
Solid levelled(Solid scan) {
    Vec3 up{0};
    for (const Facet& f : scan.facets) {
        if (f.plane.normal.z > up.z) up = f.plane.normal;
    }
    const Vec3 axis = glm::cross(up, Vec3{0, 0, 1});
    const auto level = [&](const Vec3& v) {
        return v * up.z + glm::cross(axis, v) + axis * (glm::dot(axis, v) / (1 + up.z));
    };
    for (Vec3& v : scan.vertices) v = level(v);
    for (Facet& f : scan.facets) f.plane.normal = level(f.plane.normal);
    return scan;
}

double degrees_apart(double a, double b) {
    return std::abs(degrees(std::remainder(a - b, 2 * std::numbers::pi)));
}

const Facet& nearest(const Solid& scan, double slope, double azimuth, double z) {
    const Vec3 n{std::sin(slope) * std::cos(azimuth), std::sin(slope) * std::sin(azimuth), z};
    const Facet* best = &scan.facets[0];
    for (const Facet& f : scan.facets) {
        if (glm::dot(n, f.plane.normal) > glm::dot(n, best->plane.normal)) best = &f;
    }
    return *best;
}

TEST(OutsideScans, AreTheStoneThatIsFittedToTheirReadings) {
    const std::filesystem::path sample = CULET_SOURCE_DIR "/samples/real-brilliant/stone.toml";
    const Solid scan = levelled(scanned_solid(outside::folder() / "scans/1_GIA/polyhedron.dat"));
    const StoneFile stone = read_stone(sample);
    const FitResult result = fit_stone(
        stone.stone, bind_readings(read_readings(sample), stone.stone), read_fit_options(sample));
    ASSERT_EQ(result.status, FitStatus::converged) << result.message;
    double squares = 0, worst_slope = 0, worst_azimuth = 0;
    int within = 0, count = 0;
    for (const FittedFacet& f : result.facets) {
        if (f.name[0] == 'G') continue;
        const double turned = f.azimuth - result.azimuth_zero;
        const Facet& truth = nearest(scan, f.inclination, turned, f.plane.normal.z);
        const Vec3 n = truth.plane.normal;
        worst_slope =
            std::max(worst_slope, degrees_apart(f.inclination, inclination(n, {0, 0, 1})));
        if (f.name != "T")
            worst_azimuth = std::max(worst_azimuth, degrees_apart(turned, azimuth(n)));
        const double off = f.area / area(scan, truth) - 1;
        fmt::print("{:4} area {:+6.1f} %\n", f.name, 100 * off);
        squares += std::pow((f.area - area(scan, truth)) / f.sigma_area, 2);
        within += std::abs(off) < 0.10 ? 1 : 0;
        ++count;
    }
    fmt::print(
        "inclination {:.3f}, azimuth {:.3f} degrees off at worst; {} of {} areas within 10 %\n",
        worst_slope, worst_azimuth, within, count);
    EXPECT_EQ(count, 57);
    EXPECT_LT(worst_slope, 0.15);
    EXPECT_LT(worst_azimuth, 0.15);
    EXPECT_GE(within, 48);
    EXPECT_NEAR(std::sqrt(squares / count), 0.9, 0.4);
    EXPECT_NEAR(width_along(result.solid, {0, 0, 1}), width_along(scan, {0, 0, 1}), 0.02);
    for (int k = 0; k < 12; ++k) {
        const double a = radians(15.0 * k), b = a + result.azimuth_zero;
        EXPECT_NEAR(width_along(result.solid, {std::cos(b), std::sin(b), 0}),
                    width_along(scan, {std::cos(a), std::sin(a), 0}), 0.02)
            << 15 * k;
    }
}

}  // namespace
}  // namespace culet
