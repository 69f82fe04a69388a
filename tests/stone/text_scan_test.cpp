#include "stone/text/text_scan.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace culet {
namespace {

TEST(TextScan, LinesEndInAnyOfThreeWays) {
    LineReader lines("a\nb\r\nc\rd\n\ne");
    for (const char* expected : {"a", "b", "c", "d", "", "e"}) EXPECT_EQ(lines.next(), expected);
    EXPECT_EQ(lines.line(), 6);
    EXPECT_EQ(lines.next(), std::nullopt);
}

TEST(TextScan, NumbersFillTheirWord) {
    EXPECT_EQ(number_in("1"), 1.0);
    EXPECT_EQ(number_in("+4."), 4.0);
    EXPECT_EQ(number_in("-2.5e-3"), -2.5e-3);
    EXPECT_EQ(number_in(".5"), 0.5);
    EXPECT_EQ(number_in("1e-999"), 0.0);
    for (const char* word :
         {"", "+", "-", "1x", "nan", "inf", "-inf", "1e999", "0x10", "1,5", "--1", "1e", "one"}) {
        EXPECT_EQ(number_in(word), std::nullopt) << word;
    }
    EXPECT_EQ(integer_in("-7"), -7);
    for (const char* word : {"", "1.0", "99999999999999999999", "7a"}) {
        EXPECT_EQ(integer_in(word), std::nullopt) << word;
    }
}

TEST(TextScan, ShownWordsAreShortAndPrintable) {
    EXPECT_EQ(shown("a\033[1mb"), "a?[1mb");
    EXPECT_LE(shown(std::string(1000, 'x')).size(), 43u);
}

// The rounding inferred from the digits must be the true one: numbers are printed in a format, read
// back, and compared with the originals.
TEST(WrittenPrecision, FindsTheRoundingOfCommonForms) {
    std::mt19937_64 generator(5);
    std::uniform_real_distribution<double> coordinate(-8, 8);
    struct Case {
        const char* form;
        double most;  // largest inferred rounding
    };
    for (const Case& c : {Case{"{:.6f}", 0.51e-6}, Case{"{:.3f}", 0.51e-3}, Case{"{:.6e}", 0.51e-6},
                          Case{"{:.7g}", 0.51e-6}, Case{"{:.17g}", 1e-15}, Case{"{}", 1e-15}}) {
        SCOPED_TRACE(c.form);
        WrittenPrecision precision;
        double worst = 0;
        for (int i = 0; i < 300; ++i) {
            const double value = coordinate(generator);
            const std::string word = fmt::format(fmt::runtime(c.form), value);
            const double read = number_in(word).value();
            precision.add(word, read);
            worst = std::max(worst, std::abs(read - value));
        }
        EXPECT_GE(precision.rounding() * (1 + 1e-9), worst);
        EXPECT_LE(precision.rounding(), c.most);
    }
}

// They could be single precision, so that is assumed: 20 has a rounding of 6e-8 of itself.
TEST(WrittenPrecision, ShortExactNumbersAreNotTakenForCoarse) {
    WrittenPrecision precision;
    for (const char* word : {"0", "1.25", "-2", "0.5", "3.125", "7.0625", "1.3", "20"}) {
        precision.add(word, number_in(word).value());
    }
    EXPECT_LT(precision.rounding(), 1.3e-6);
}

TEST(WrittenPrecision, SinglePrecisionInManyDigitsIsSeenThrough) {
    std::mt19937_64 generator(6);
    std::uniform_real_distribution<float> coordinate(-1, 1);
    WrittenPrecision precision;
    for (int i = 0; i < 100; ++i) {
        const std::string word = fmt::format("{:.17g}", static_cast<double>(coordinate(generator)));
        precision.add(word, number_in(word).value());
    }
    EXPECT_GT(precision.rounding(), 2e-8);
    EXPECT_LT(precision.rounding(), 1e-7);
}

}  // namespace
}  // namespace culet
