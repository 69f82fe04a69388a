// Planes known from elsewhere (a photograph) in the fit of a stone.

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "fit/fit.h"
#include "fit/planes/plane_observations.h"
#include "fit/silhouettes/silhouette_fit.h"
#include "tests/fit/test_stones.h"
#include "tests/fit/turntable_outlines.h"

namespace culet {
namespace {

constexpr double k_sigma = 1e-4;

// Of a cube with edges of 2: how far the normal of X+ leans up, and how far X- lies outwards.
Reading photograph(const Solid& solid, double lean, double out) {
    auto known = std::make_shared<PlaneObservations>();
    for (const Facet& facet : solid.facets) known->planes.push_back(facet.plane);
    const std::size_t facets = solid.facets.size();
    const auto row = [&](const char* name, const Vec3& normal, double offset, double value) {
        PlaneObservations::Row one{std::vector<Vec3>(facets, Vec3(0)),
                                   std::vector<double>(facets, 0), value / k_sigma};
        const auto f = std::size_t(find_facet(solid, name));
        one.normal[f] = normal / k_sigma;
        one.offset[f] = offset / k_sigma;
        return one;
    };
    known->rows.push_back(row("X+", {0, 0, 1}, 0, lean));
    // Shifts along x are unobservable, as they are from pictures.
    known->rows.push_back(row("X-", {0, 0, 0}, 1, out));
    known->rows.back().offset[std::size_t(find_facet(solid, "X+"))] = 1 / k_sigma;
    Reading reading;
    reading.id = "photo";
    reading.kind = ReadingKind::photograph;
    reading.photograph = known;
    return reading;
}

Reading caliper(ReadingKind kind, const Vec3& direction, double value) {
    Reading reading;
    reading.kind = kind;
    reading.id = kind == ReadingKind::depth ? "depth" : direction.x > 0 ? "x" : "y";
    reading.direction = direction;
    reading.has_direction = kind == ReadingKind::width;
    reading.value = value;
    reading.sigma = 0.01;
    return reading;
}

// Least squares with readings that carry a hundredth of the information: the planes end where the
// rows say, everything else where the mesh has it.
TEST(KnownPlanes, MoveTheFit) {
    // Wider along y: the lean of X+ says nothing of Y+.
    Solid block = test::cube();
    for (Vec3& v : block.vertices) v.y *= 1.5;
    for (Facet& facet : block.facets)
        facet.plane.offset *= 1 + 0.5 * std::abs(facet.plane.normal.y);
    const Stone stone = test::stone_of(block);
    const double lean = 0.02, out = 0.01;
    FitOptions options;
    options.prior.source = Prior::Source::mesh;
    const FitResult fit =
        fit_stone(stone,
                  {caliper(ReadingKind::width, {0, 1, 0}, 3), caliper(ReadingKind::depth, {}, 2),
                   photograph(stone.solid, lean, out)},
                  options);
    EXPECT_EQ(fit.status, FitStatus::converged) << fit.message;
    const auto plane = [&](const char* name) {
        return fit.solid.facets[std::size_t(find_facet(fit.solid, name))].plane;
    };
    EXPECT_NEAR(plane("X+").normal.z, lean, 3 * k_sigma);
    EXPECT_NEAR(plane("X+").offset + plane("X-").offset, 2 + out, 3 * k_sigma);
    EXPECT_NEAR(plane("Y+").normal.z, 0, 3 * k_sigma);
    const FittedFacet& leaning = fit.facets[std::size_t(find_facet(stone.solid, "X+"))];
    EXPECT_NEAR(leaning.sigma_inclination, k_sigma, 0.05 * k_sigma);
    EXPECT_EQ(fit.readings.back().kind, ReadingKind::photograph);
}

// Outlines that show each plane twice, exactly where the mesh has it.
Reading outlines(const Solid& solid) {
    auto known = std::make_shared<OutlineObservations>();
    for (const Facet& facet : solid.facets) known->planes.push_back(facet.plane);
    const std::size_t facets = solid.facets.size();
    for (std::size_t f = 0; f < facets; ++f) {
        for (const Vec3& axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
            PlaneObservations::Row row{std::vector<Vec3>(facets, Vec3(0)),
                                       std::vector<double>(facets, 0), 0};
            const bool is_across = std::abs(glm::dot(axis, solid.facets[f].plane.normal)) < 0.5;
            if (is_across) row.normal[f] = axis / k_sigma;
            if (!is_across) row.offset[f] = 1 / k_sigma;
            known->rows.insert(known->rows.end(), 2, row);
        }
    }
    known->motions = {FrameMotion{}};
    known->sigmas = {k_sigma};
    known->estimated = {false};
    Reading reading;
    reading.id = "outlines";
    reading.kind = ReadingKind::silhouette;
    reading.outline_observations = known;
    reading.outlines =
        std::make_shared<const SilhouetteSet>(test::turntable_outlines(solid, {.views = 4}));
    return reading;
}

// Values may have been copied; outlines have none.
TEST(KnownPlanes, OfOutlinesAloneAreNotSaidToAgreeTooWell) {
    const Stone stone = test::stone_of(test::cube());
    const auto is_too_good = [](const FitResult& fit) {
        EXPECT_GT(fit.statistics.dof, 5);
        EXPECT_LT(fit.statistics.chi2, 1e-6);
        return fit.message.find("copied") != std::string::npos;
    };
    EXPECT_FALSE(is_too_good(fit_stone(stone, {outlines(stone.solid)})));
    EXPECT_TRUE(is_too_good(
        fit_stone(stone, {caliper(ReadingKind::width, {0, 1, 0}, 2), outlines(stone.solid)})));
}

}  // namespace
}  // namespace culet
