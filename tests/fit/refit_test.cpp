// Refitting from an earlier result after one reading was edited.

#include "fit/starts/refit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "fit/model/orbits.h"
#include "fit/solve/caliper_turn.h"
#include "tests/fit/fit_trials.h"

namespace culet {
namespace {

using namespace bench;

FitOptions without_findings() {
    FitOptions options;
    options.findings = false;
    return options;
}

struct Fitted {
    Truth truth;
    std::vector<WrittenReading> readings;
    FitResult result;
};
Fitted fitted_step_cut(unsigned seed) {
    Fitted f{make_truth(TruthKind::step, false, seed), {}, {}};
    f.readings = read_by_instruments(f.truth, 1000 + seed);
    f.result = fit_mesh(f.truth.stone, f.readings, without_findings()).result;
    return f;
}

FitResult refitted(const Fitted& f, const std::vector<WrittenReading>& readings) {
    FitOptions options = without_findings();
    options.start = f.result.solid;
    return fit_mesh(f.truth.stone, readings, options).result;
}

// A result file keeps the mesh's orientation. However that is turned a little, the jaws find the
// same place.
TEST(Refit, AResultIsLaidBetweenTheJawsAsItWasFitted) {
    // Stones whose best orientation is not at the end of the searched range.
    for (const unsigned seed : {1u, 3u, 4u}) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        const Fitted f = fitted_step_cut(seed);
        const FitModel model(f.truth.stone, bind_readings(f.readings, f.truth.stone), {});
        const Parameters parameters = model.parameters();
        const Relaxation relaxation(model, parameters);
        const Shape told = *shape_of(model, f.result.solid);
        const Shape laid = turned_to_calipers(relaxation, told);
        for (const double by : {-1e-3, 2e-3}) {
            const Shape again = turned_to_calipers(relaxation, turned_about_z(told, by));
            double worst = 0;
            for (std::size_t p = 0; p < laid.points.size(); ++p) {
                // A smooth minimum is found to the square root of rounding error.
                worst = std::max(worst, glm::length(again.points[p] - laid.points[p]));
            }
            EXPECT_LT(worst, 1e-6) << by;
        }
    }
}

// Sides of a step cut lie flush between the jaws: corners that a fit left level share their jaws
// from the start, so the last stage has little more to do than check.
TEST(Refit, JawsRestWhereTheyRested) {
    int shared_contacts = 0, few = 0;
    constexpr int k_stones = 10;
    for (unsigned seed = 1; seed <= k_stones; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        Fitted f = fitted_step_cut(seed);
        const FitModel model(f.truth.stone, bind_readings(f.readings, f.truth.stone), {});
        const Parameters parameters = model.parameters();
        Relaxation relaxation(model, parameters);
        const Shape laid = turned_to_calipers(relaxation, *shape_of(model, f.result.solid));
        relaxation.forget_contacts();
        relaxation.select_branches(laid, true);
        relaxation.share_level_corners(laid);
        for (const SharedContact& tie : relaxation.shared_contacts())
            shared_contacts += tie.direction.z == 0;
        const auto edge = std::find_if(f.readings.begin(), f.readings.end(),
                                       [](const WrittenReading& r) { return r.kind == "edge"; });
        *edge->value += 0.5 * *edge->sigma;
        const FitResult again = refitted(f, f.readings);
        EXPECT_EQ(again.log.start, "earlier result");
        few += again.log.iterations <= 2;
        // The search for facets that lean the other way and gain less is skipped.
        EXPECT_LT(
            again.statistics.chi2,
            fit_mesh(f.truth.stone, f.readings, without_findings()).result.statistics.chi2 + 2);
    }
    EXPECT_GT(shared_contacts, k_stones);
    // Where the edited reading takes a jaw off one of two corners, one more step is needed.
    EXPECT_GT(few, k_stones / 2);
}

// A width read larger than the stone pulls corners outwards: no jaw touches two of them.
TEST(Refit, AJawThatIsPulledAwayLetsGo) {
    for (unsigned seed = 1; seed <= 5; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        Fitted f = fitted_step_cut(seed);
        for (WrittenReading& r : f.readings) {
            if (r.kind == "width") *r.value += 4 * *r.sigma;
        }
        const FitResult again = refitted(f, f.readings);
        // The last stage from the same shape, at first without any jaw on two corners.
        const FitModel model(f.truth.stone, bind_readings(f.readings, f.truth.stone), {});
        const Parameters parameters = model.parameters();
        const Shape laid =
            turned_to_calipers({model, parameters}, *shape_of(model, f.result.solid));
        const Candidate free = finish_from(model, laid, 100);
        EXPECT_EQ(again.log.start, "earlier result");
        EXPECT_LT(again.statistics.chi2, free.finished.chi2 + 1);
    }
}

}  // namespace
}  // namespace culet
