// Stones from their outlines, compared with known stones.

#include "fit/silhouettes/silhouette_fit.h"

#include <gtest/gtest.h>

#include "fit/fit.h"
#include "fit/silhouettes/registration.h"
#include "stone/text/errors.h"
#include "tests/fit/test_stones.h"
#include "tests/fit/turntable_outlines.h"

namespace culet {
namespace {

using test::brilliant;
using test::off_standard;
using test::stone_of;
using test::Turntable;
using test::turntable_outlines;

// The catalogue's design in another size and pose.
Stone catalogue(double scale, double turn_deg, const Vec3& shift) {
    Solid solid = brilliant();
    const double a = radians(turn_deg);
    for (Vec3& v : solid.vertices) {
        v = scale * Vec3{std::cos(a) * v.x - std::sin(a) * v.y,
                         std::sin(a) * v.x + std::cos(a) * v.y, v.z} +
            shift;
    }
    for (Facet& f : solid.facets) {
        std::vector<Vec3> loop;
        for (const int c : f.corners) loop.push_back(solid.vertices[std::size_t(c)]);
        f.plane = plane_through(loop);
    }
    return stone_of(solid);
}

FitOptions without_findings() {
    FitOptions options;
    options.findings = false;
    return options;
}

FitInput input_of(const Stone& mesh, SilhouetteSet set, std::vector<WrittenReading> others = {}) {
    WrittenReading written;
    written.kind = "silhouette";
    written.outlines = std::make_shared<const SilhouetteSet>(std::move(set));
    others.push_back(written);
    return fit_input(mesh, others);
}

// Angles between normals of facets of the same name, and errors of inclinations in units of their
// sigmas.
struct Errors {
    double rms_deg = 0, worst_deg = 0, within_sigma = 0;
    int facets = 0;
};

// Compares facets with the truth turned by `turn` about the vertical: nothing tells which of eight
// ways round a catalogue brilliant is.
Errors errors_at(const FitResult& result, const Solid& truth, double least_area, double turn) {
    Errors errors;
    double squares = 0;
    int within = 0;
    for (const Facet& t : truth.facets) {
        if (area(truth, t) < least_area || t.name == "T") continue;
        const Vec3& n = t.plane.normal;
        const Vec3 turned{std::cos(turn) * n.x - std::sin(turn) * n.y,
                          std::sin(turn) * n.x + std::cos(turn) * n.y, n.z};
        const auto nearest = std::min_element(result.facets.begin(), result.facets.end(),
                                              [&](const FittedFacet& a, const FittedFacet& b) {
                                                  return glm::dot(a.plane.normal, turned) >
                                                         glm::dot(b.plane.normal, turned);
                                              });
        const double off = nearest->inclination - inclination(n, {0, 0, 1});
        errors.worst_deg =
            std::max(errors.worst_deg, degrees(angle_between(nearest->plane.normal, turned)));
        squares += off * off;
        within += std::abs(off) < nearest->sigma_inclination;
        ++errors.facets;
    }
    errors.rms_deg = degrees(std::sqrt(squares / errors.facets));
    errors.within_sigma = double(within) / errors.facets;
    return errors;
}

Errors errors_of(const FitResult& result, const Solid& truth, double least_area,
                 double turn_deg = 0) {
    Errors best;
    for (int k = 0; k < 8; ++k) {
        const Errors errors = errors_at(result, truth, least_area, radians(45.0 * k + turn_deg));
        if (k == 0 || errors.rms_deg < best.rms_deg) best = errors;
    }
    return best;
}

// Without noise only the finite number of outline points separates the fit from the truth.
TEST(SilhouetteFit, FindsSizeTurnAndEveryFacetOfAStoneThatIsNoStandard) {
    const Solid truth = off_standard(brilliant(), 0.4, 0.01, 7);
    SilhouetteSet set = turntable_outlines(truth, {.views = 120, .points = 500, .sigma = 1e-4});
    set.is_free = true;
    const FitInput input = input_of(catalogue(1.15, 17, {3, -2, 5}), std::move(set));
    const FitResult result = fit_stone(input);
    EXPECT_TRUE(result.checks.closed && result.checks.convex);
    const Errors errors = errors_of(result, truth, 0.1, 17);
    EXPECT_LT(errors.rms_deg, 0.05);
    EXPECT_LT(errors.worst_deg, 2);
    ASSERT_TRUE(result.readings.back().silhouette);
    EXPECT_LT(result.readings.back().silhouette->misfit.rms, 1.2e-4);
}

// Sigmas claim 68 %. Most of the 600 inclinations are correlated in groups of ten, so the share
// within one sigma scatters by sqrt(0.68 * 0.32 / 60) = 6 %.
TEST(SilhouetteFit, SigmasHoldAndAreFoundFromTheResiduals) {
    double within = 0;
    int count = 0;
    constexpr int k_stones = 4;
    for (unsigned seed = 1; seed <= k_stones; ++seed) {
        const Solid truth = off_standard(brilliant(), 0.3, 0.008, 20 + seed);
        SilhouetteSet set =
            turntable_outlines(truth, {.views = 72, .points = 400, .sigma = 0.001, .seed = seed});
        const FitResult result =
            fit_stone(input_of(catalogue(1, 0, {0, 0, 0}), std::move(set)), without_findings());
        const Errors errors = errors_of(result, truth, 0.02);
        EXPECT_LT(errors_of(result, truth, 0.3).rms_deg, 0.05) << seed;
        within += errors.within_sigma * errors.facets;
        count += errors.facets;
        ASSERT_TRUE(result.readings.back().silhouette);
        const SilhouetteFinding& finding = *result.readings.back().silhouette;
        EXPECT_TRUE(finding.estimated);
        // The sigma from 28 800 points has a relative error of 1 / sqrt(2 n) = 0.4 %; allowed are
        // five times that.
        EXPECT_NEAR(finding.sigma, 0.001, 0.00002);
    }
    EXPECT_NEAR(within / count, 0.683, 0.18);
}

// Dust sticks out of the outline; the holder hides the culet and sticks out far.
TEST(SilhouetteFit, DustAndTheHolderDoNotCount) {
    const Solid truth = off_standard(brilliant(), 0.3, 0.008, 5);
    SilhouetteSet set = turntable_outlines(truth, {.views = 72, .points = 400, .sigma = 0.001});
    for (std::size_t c = 0; c < set.contours.size(); ++c) {
        for (std::size_t i = 0; i < set.contours[c].points.size(); ++i) {
            Vec3& p = set.contours[c].points[i];
            if (p.z < -2.0) p.z -= 1.5;
            if (c % 3 == 0 && i % 40 < 3) p *= 1.03;
        }
    }
    set.is_free = true;
    const FitResult result = fit_stone(input_of(catalogue(1.05, 5, {0, 0, 0}), std::move(set)));
    const Errors errors = errors_of(result, truth, 0.3, 5);
    EXPECT_LT(errors.rms_deg, 0.08);
    EXPECT_GT(result.readings.back().silhouette->misfit.outliers, 500);
}

// Two independent values of one quantity are weighted by 1/sigma^2 (Gauss): an inclination read as
// precisely as the outlines give it, but two of its sigmas off, moves the facet by one.
TEST(SilhouetteFit, ReadingsAndOutlinesAreOneLeastSquares) {
    const Solid truth = off_standard(brilliant(), 0.3, 0.008, 9);
    const SilhouetteSet set =
        turntable_outlines(truth, {.views = 72, .points = 400, .sigma = 0.002});
    const Stone mesh = catalogue(1, 0, {0, 0, 0});
    const FitResult alone = fit_stone(input_of(mesh, set), without_findings());
    const auto facet = [](const FitResult& r, const char* name) {
        return *std::find_if(r.facets.begin(), r.facets.end(),
                             [&](const FittedFacet& f) { return f.name == name; });
    };
    const FittedFacet before = facet(alone, "P3");
    WrittenReading w;
    w.kind = "inclination";
    w.of = {"P3"};
    w.value = degrees(std::numbers::pi - before.inclination + 2 * before.sigma_inclination);
    w.sigma = degrees(before.sigma_inclination);
    const FitResult both = fit_stone(input_of(mesh, set, {w}), without_findings());
    const FittedFacet after = facet(both, "P3");
    // One more reading than unknowns, off by one sigma, as precise as the outlines.
    EXPECT_NEAR(both.statistics.dof, 1, 0.01);
    EXPECT_NEAR(both.statistics.chi2, 2, 0.02);
    EXPECT_NEAR(after.inclination, before.inclination - before.sigma_inclination,
                0.02 * before.sigma_inclination);
    EXPECT_NEAR(after.sigma_inclination, before.sigma_inclination / std::numbers::sqrt2,
                0.02 * before.sigma_inclination);
}

TEST(SilhouetteFit, RefusesMeetsOfTheMeshAndItsCorners) {
    const SilhouetteSet set = turntable_outlines(brilliant(), {.views = 12, .points = 200});
    const Stone mesh = catalogue(1, 0, {0, 0, 0});
    FitOptions options;
    options.meets = MeetTreatment::soft;
    options.meets_named = true;
    EXPECT_THROW(fit_stone(input_of(mesh, set), options), InputError);
    WrittenReading w;
    w.kind = "distance";
    w.of = {"v1", "v2"};
    w.value = 1;
    w.sigma = 0.1;
    EXPECT_THROW(input_of(mesh, set, {w}), InputError);
}

}  // namespace
}  // namespace culet
