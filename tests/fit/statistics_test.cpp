#include "fit/uncertainty/statistics.h"

#include <gtest/gtest.h>

#include <cmath>

namespace culet {
namespace {

// Two degrees of freedom have a closed form: exp(-x/2).
TEST(Chi2Tail, TwoDegreesOfFreedomIsExponential) {
    for (const double x : {0.1, 1.0, 5.0, 20.0, 200.0}) {
        EXPECT_NEAR(chi2_tail(x, 2) / std::exp(-0.5 * x), 1, 1e-11) << x;
    }
}

// One degree of freedom is the two-sided normal tail: erfc(sqrt(x/2)).
TEST(Chi2Tail, OneDegreeOfFreedomIsNormal) {
    for (const double x : {0.01, 1.0, 3.841458820694124, 30.0}) {
        EXPECT_NEAR(chi2_tail(x, 1) / std::erfc(std::sqrt(0.5 * x)), 1, 1e-11) << x;
    }
}

// Table 26.8 of Abramowitz & Stegun: 0.001 points for 10, 30 and 100 degrees of freedom.
TEST(Chi2Quantile, MatchesTheTable) {
    EXPECT_NEAR(chi2_quantile(0.001, 10), 29.588, 1e-3);
    EXPECT_NEAR(chi2_quantile(0.001, 30), 59.703, 1e-3);
    EXPECT_NEAR(chi2_quantile(0.001, 100), 149.449, 1e-3);
    EXPECT_NEAR(chi2_quantile(0.05, 1), 3.8415, 1e-4);
}

// Closed form, also where the probability is tiny.
TEST(Chi2LowerTail, TwoDegreesOfFreedomIsExponential) {
    for (const double x : {1e-12, 0.1, 1.0, 5.0}) {
        EXPECT_NEAR(chi2_lower_tail(x, 2) / -std::expm1(-0.5 * x), 1, 1e-11) << x;
    }
    EXPECT_EQ(chi2_lower_tail(0, 0), 1);
}

TEST(Chi2Tail, NoDegreesOfFreedomNeverFail) {
    EXPECT_EQ(chi2_tail(100, 0), 1);
    EXPECT_EQ(chi2_tail(0, 5), 1);
    EXPECT_EQ(chi2_quantile(0.001, 0), 0);
}

// 1.959964 and 3.290527 are the two-sided 5 % and 0.1 % points.
TEST(NormalQuantile, MatchesTheTable) {
    EXPECT_NEAR(two_sided_normal_quantile(0.05), 1.959963985, 1e-8);
    EXPECT_NEAR(two_sided_normal_quantile(0.001), 3.290526731, 1e-8);
}

}  // namespace
}  // namespace culet
