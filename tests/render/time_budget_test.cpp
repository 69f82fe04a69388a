// Expectations: arithmetic on drawings whose work rises as the tolerance to the power of -1.5.

#include "render/planner/time_budget.h"

#include <gtest/gtest.h>

#include <cmath>

#include "render/work/work_meter.h"

namespace culet {
namespace {

struct Budgeted {
    double error = 0, work = 0;
};

// `work`: of a drawing to 0.2, which comes out at 0.19; finer ones come as near to theirs.
Budgeted budgeted(double work, double allowed) {
    Scene scene;
    scene.settings.allowed_ns = allowed;
    Budgeted all;
    const RenderResult best = draw_within_budget(
        scene, {},
        [&](const Scene& attempt, const Progress&) {
            const RenderSettings& settings = attempt.settings;
            settings.meter->spend(work * std::pow(0.2 / settings.tolerance, 1.5));
            all.work = static_cast<double>(settings.meter->spent());
            settings.meter->require_not_over();
            RenderResult result;
            result.stats.error_bound = 0.95 * settings.tolerance;
            return result;
        },
        {});
    all.error = best.stats.error_bound;
    return all;
}

TEST(TimeBudget, AStoneThatTheUsualTimeLeavesRoughGetsLonger) {
    const Budgeted easy = budgeted(1e8, k_usual_budget_ns);
    EXPECT_LT(easy.error, 0.03);
    EXPECT_LT(easy.work, k_usual_budget_ns);
    // Of 4e9 ns, 0.19 would be left; of 2e10, 0.05, at one go.
    const Budgeted hard = budgeted(2e9, k_usual_budget_ns);
    EXPECT_LT(hard.error, 0.055);
    EXPECT_LT(hard.work, k_run_budget_ns);
    // Its first picture does not fit into the usual time.
    const Budgeted harder = budgeted(8e9, k_usual_budget_ns);
    EXPECT_DOUBLE_EQ(harder.error, 0.19);
    EXPECT_LT(harder.work, k_run_budget_ns);
}

TEST(TimeBudget, AnotherTimeIsKept) {
    const Budgeted hard = budgeted(2e9, 5e9);
    EXPECT_DOUBLE_EQ(hard.error, 0.19);
    EXPECT_LT(hard.work, 5e9);
}

}  // namespace
}  // namespace culet
