// Which way facets face, deduced from the edges read around them. Expectations: how the stones were
// made.
#include "fit/starts/closing_sides.h"

#include <gtest/gtest.h>

#include <cmath>

#include "stone/solid/checks.h"
#include "tests/fit/fit_trials.h"

namespace culet {
namespace {

using namespace bench;

std::vector<WrittenReading> with_azimuths(const Truth& truth, unsigned seed) {
    std::vector<WrittenReading> readings = read_by_instruments(truth, seed);
    const std::vector<WrittenReading> azimuths = read_azimuths(truth, seed);
    readings.insert(readings.end(), azimuths.begin(), azimuths.end());
    return readings;
}

struct Found {
    int right = 0, wrong = 0, unknown = 0;
};
// From a mesh of which only the corners' positions are used.
Found sides_found(const Truth& truth, const Stone& mesh, double noise,
                  const std::vector<WrittenReading>& written) {
    const std::vector<Reading> readings = bind_readings(written, mesh);
    const FitModel model(mesh, readings, {});
    const double rough =
        noise * diameter(truth.stone.solid) / std::sqrt(3.0) / model.frame().scale();
    const std::size_t count = mesh.solid.facets.size();
    const std::vector<int> sides = closing_sides(model, std::vector<int>(count, 0), rough);
    Found found;
    for (std::size_t f = 0; f < count; ++f) {
        const Facet& facet = truth.stone.solid.facets[f];
        if (facet.name == truth.stone.up_facet) continue;
        if (sides[f] == 0) {
            ++found.unknown;
        } else {
            ++((sides[f] > 0) == (facet.plane.normal.z > 0) ? found.right : found.wrong);
        }
    }
    return found;
}

Stone aimed_at_zero(Stone mesh) {
    mesh.azimuth_from_mesh = true;
    return mesh;
}

TEST(ClosingSides, OfEveryFacetAreFoundFromACrudeMesh) {
    for (unsigned seed = 1; seed <= 3; ++seed) {
        const Truth truth = make_tiered(120, seed);
        const double noise = 0.03;
        const Stone mesh = aimed_at_zero(noisy_mesh(truth.stone, noise, seed));
        const Found found = sides_found(truth, mesh, noise, with_azimuths(truth, seed));
        EXPECT_EQ(found.wrong, 0) << seed;
        EXPECT_GT(found.right, 9 * found.unknown) << seed;
    }
}

TEST(ClosingSides, AreLeftAloneWhereTheMeshKnowsThem) {
    const Truth truth = make_tiered(60, 1);
    const Stone mesh = aimed_at_zero(truth.stone);
    const std::vector<Reading> readings = bind_readings(with_azimuths(truth, 1), mesh);
    const FitModel model(mesh, readings, {});
    // Known sides stay fixed, even wrong ones.
    const std::vector<int> known(mesh.solid.facets.size(), 1);
    EXPECT_EQ(closing_sides(model, known, 0.01), known);
}

TEST(ClosingSides, AreNotToldWithoutAzimuths) {
    const Truth truth = make_tiered(60, 1);
    const std::vector<Reading> readings = bind_readings(read_by_instruments(truth, 1), truth.stone);
    const FitModel model(truth.stone, readings, {});
    const std::vector<int> none(truth.stone.solid.facets.size(), 0);
    EXPECT_EQ(closing_sides(model, none, 0.01), none);
}

// Neighbours along the girdle that all lean the wrong way stabilise each other: flipping any one of
// them alone makes chi-square larger.
TEST(ClosingSides, LetAStoneOfManyGirdleFacetsBeFoundFromAShakenMesh) {
    const Truth truth = make_tiered(200, 4);
    const auto readings = with_azimuths(truth, 5);
    const Trial reference = fit_mesh(aimed_at_zero(truth.stone), readings);
    const Trial trial = fit_mesh(aimed_at_zero(noisy_mesh(truth.stone, 0.01, 6)), readings);
    EXPECT_TRUE(succeeds(truth.stone, trial, reference))
        << trial.result.statistics.chi2 << " against " << reference.result.statistics.chi2 << "; "
        << trial.result.message << trial.refusal;
}

}  // namespace
}  // namespace culet
