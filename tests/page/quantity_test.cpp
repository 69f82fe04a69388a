// Expectations: the rule of the GUM (JCGM 100:2008, 7.2.6), two digits of the uncertainty and the
// value to the same place, worked out by hand.

#include "page/quantity.h"

#include <gtest/gtest.h>

#include <limits>

namespace culet {
namespace {

constexpr double k_nan = std::numeric_limits<double>::quiet_NaN();
constexpr double k_infinite = std::numeric_limits<double>::infinity();

TEST(Quantity, HasTwoDigitsOfSigmaAndTheValueToTheSamePlace) {
    EXPECT_EQ(quantity(33.78684, 0.098784, "deg"), "33.787 ± 0.099°");
    EXPECT_EQ(quantity(10.168568, 0.0064658, "mm"), "10.1686 ± 0.0065\u00a0mm");
    EXPECT_EQ(quantity(58.43847, 0.25538, "mm3"), "58.44 ± 0.26\u00a0mm³");
    EXPECT_EQ(quantity(61.57584, 0.17369, "%"), "61.58 ± 0.17\u00a0%");
    EXPECT_EQ(quantity(1.28285, 0.002025, ""), "1.2829 ± 0.0020");
    EXPECT_EQ(quantity(214336.4, 1234, "mm"), "214300 ± 1200\u00a0mm");
}

TEST(Quantity, RoundsSigmaBeforeItsDigitsAreCounted) {
    EXPECT_EQ(quantity(5, 0.0996, "mm"), "5.00 ± 0.10\u00a0mm");
    EXPECT_EQ(quantity(500, 99.7, "mm"), "500 ± 100\u00a0mm");
}

TEST(Quantity, OfNegativeValuesHasATrueMinusAndNoNegativeZero) {
    EXPECT_EQ(quantity(-0.0268, 0.1, "deg"), "−0.03 ± 0.10°");
    EXPECT_EQ(quantity(-0.0004, 0.1, "deg"), "0.00 ± 0.10°");
}

TEST(Quantity, FinerThanAnyDisplayIsExact) {
    EXPECT_EQ(quantity(0, 4.8e-21, "deg"), "0° (held exactly)");
    EXPECT_EQ(quantity(90, 0, "deg"), "90° (held exactly)");
    EXPECT_EQ(quantity(45.125, 1e-9, "deg"), "45.125° (held exactly)");
    EXPECT_EQ(quantity(1e-27, 0, "deg"), "0° (held exactly)");
}

TEST(Quantity, WithoutAUsableSigmaIsTheValueAlone) {
    EXPECT_EQ(quantity(6.52, std::nullopt, "mm"), "6.5200\u00a0mm");
    EXPECT_EQ(quantity(6.52, k_nan, "mm"), "6.5200\u00a0mm");
    EXPECT_EQ(quantity(6.52, k_infinite, "mm"), "6.5200\u00a0mm");
    EXPECT_EQ(quantity(6.52, -1, "mm"), "6.5200\u00a0mm");
}

TEST(Quantity, OfNothingIsADash) {
    EXPECT_EQ(quantity(std::nullopt, 0.1, "deg"), "–");
    EXPECT_EQ(quantity(k_nan, 0.1, "deg"), "–");
    EXPECT_EQ(quantity(k_infinite, 0.1, "deg"), "–");
}

TEST(Quantity, OfHugeNumbersStaysShort) {
    EXPECT_EQ(quantity(41, 214336, "deg"), "not known");
    EXPECT_EQ(quantity(1e300, 1e299, "mm"), "1.0e+300 ± 1.0e+299\u00a0mm");
    EXPECT_LT(quantity(1e300, 0.1, "mm").size(), 40u);
    EXPECT_LT(quantity(1e300, 0, "mm").size(), 40u);
    EXPECT_LT(quantity(-1e300, std::nullopt, "mm").size(), 40u);
}

TEST(Quantity, NamesNoSlipWhereNothingChecks) {
    EXPECT_EQ(smallest_slip(0.53, 33.8, "deg"), "0.53°");
    EXPECT_EQ(smallest_slip(214336, 33.8, "deg"), "any slip would pass");
    EXPECT_EQ(smallest_slip(7.15, 6.52, "mm"), "any slip would pass");
    EXPECT_EQ(smallest_slip(0.071, 6.52, "mm"), "0.071\u00a0mm");
    EXPECT_EQ(smallest_slip(std::nullopt, 6.52, "mm"), "–");
    EXPECT_EQ(smallest_slip(0, 6.52, "mm"), "–");
}

TEST(Quantity, LeavesEscapingToThePage) {
    EXPECT_EQ(quantity(1, 0.1, "<b>"), "1.00 ± 0.10\u00a0<b>");
}

TEST(Quantity, TypesetsSentencesOfTheFitAndNotNames) {
    EXPECT_EQ(typeset("P3 and P4 are 0.6 degrees (+- 0.1) steeper"),
              "P3 and P4 are 0.6° (± 0.1) steeper");
    EXPECT_EQ(typeset("an area of 0.019 mm2, a volume of 3 mm3."),
              "an area of 0.019 mm², a volume of 3 mm³.");
    EXPECT_EQ(typeset("my degrees.csv line 4: 38.3 degrees"), "my degrees.csv line 4: 38.3°");
    EXPECT_EQ(typeset("facet Amm3, mm3x and a+- b"), "facet Amm3, mm3x and a+- b");
    EXPECT_EQ(typeset("planes miss by 10 um, sigma 1.2 um: release it"),
              "planes miss by 10 µm, sigma 1.2 µm: release it");
    EXPECT_EQ(typeset(""), "");
}

}  // namespace
}  // namespace culet
