// Expectations: the steps from which the turns were made.

#include "compare/turntable/stepped_turns.h"

#include <gtest/gtest.h>

#include <cmath>

#include "stone/numbers/units.h"

namespace culet {
namespace {

std::vector<double> even(std::size_t count, double step_deg) {
    std::vector<double> turns;
    for (std::size_t i = 0; i < count; ++i) turns.push_back(radians(step_deg) * double(i));
    return turns;
}

// Up to 0.3 degrees, of mean 0.
double wobble(std::size_t i) {
    return radians(0.3) * std::sin(2.4 * double(i));
}

TEST(SteppedTurns, AWobbleIsNoStep) {
    const std::vector<double> given = even(60, 6);
    std::vector<double> found = given;
    for (std::size_t i = 0; i < found.size(); ++i) found[i] += wobble(i);
    found[0] += radians(1.0);
    const SteppedTurns steps = stepped_turns(given, found);
    EXPECT_EQ(steps.turns, given);
    EXPECT_EQ(steps.scale, 1);
    EXPECT_TRUE(steps.jumps.empty());
}

TEST(SteppedTurns, FollowsMissingAndDoubledSteps) {
    const std::vector<double> given = even(60, -6);
    std::vector<double> found = given, truth = given;
    for (std::size_t i = 0; i < found.size(); ++i) {
        truth[i] -= radians(6) * ((i > 20) - (i > 40));
        found[i] = truth[i] + wobble(i);
    }
    const SteppedTurns steps = stepped_turns(given, found);
    ASSERT_EQ(steps.jumps.size(), 2u);
    EXPECT_EQ(steps.jumps[0].before, 20u);
    EXPECT_NEAR(steps.jumps[0].steps, 1, 0.1);
    EXPECT_EQ(steps.jumps[1].before, 40u);
    EXPECT_NEAR(steps.jumps[1].steps, -1, 0.1);
    for (std::size_t i = 0; i < truth.size(); ++i)
        EXPECT_NEAR(degrees(steps.turns[i] - truth[i]), 0, 0.1) << i;
}

TEST(SteppedTurns, FindsStepsOfAnotherSize) {
    const std::vector<double> given = even(60, 6);
    std::vector<double> found;
    for (std::size_t i = 0; i < given.size(); ++i) found.push_back(0.95 * given[i] + wobble(i));
    const SteppedTurns steps = stepped_turns(given, found);
    EXPECT_NEAR(steps.scale, 0.95, 0.001);
    EXPECT_TRUE(steps.jumps.empty());
    for (std::size_t i = 0; i < given.size(); ++i)
        EXPECT_NEAR(degrees(steps.turns[i] - 0.95 * given[i]), 0, 0.3) << i;
}

}  // namespace
}  // namespace culet
