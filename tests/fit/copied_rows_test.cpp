// Distinguishes rows that were copied from rows that were read again. Expectations: the chance that
// readings with a given sigma fall into one step of the scale (copied_rows.h).

#include "fit/readings/copied_rows.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "stone/cuts/cuts.h"
#include "tests/says.h"

namespace culet {
namespace {

WrittenReading width_row(const std::string& azimuth, double value, double sigma) {
    WrittenReading w;
    w.kind = "width";
    w.of = {azimuth};
    w.value = value;
    w.sigma = sigma;
    w.file = "readings.csv";
    return w;
}

// Two readings to 0.01 with a sigma of two steps agree in at most one case of five.
TEST(CopiedRows, AreNotThoseThatWereReadAgain) {
    const std::vector<WrittenReading> rows{width_row("0", 6.52, 0.02), width_row("0", 6.52, 0.02),
                                           width_row("0", 6.53, 0.02), width_row("45", 6.5, 0.02)};
    EXPECT_THAT(copied_rows(rows), testing::Each(false));
}

// With four decimals and a sigma of 0.01 one pair agrees in 4 cases of 1000, two pairs in 16 of a
// million.
TEST(CopiedRows, RepeatEveryDigit) {
    std::vector<WrittenReading> rows{width_row("0", 6.5204, 0.01), width_row("45", 6.4987, 0.01)};
    const auto first = rows;
    rows.insert(rows.end(), first.begin(), first.end());
    EXPECT_THAT(copied_rows(rows), testing::ElementsAre(false, false, true, true));
    rows[3].value = 6.4991;
    EXPECT_THAT(copied_rows(rows), testing::Each(false)) << "one alike of two, by chance";
}

// Whole numbers say nothing of their scale, except that its step is not much larger than sigma.
TEST(CopiedRows, OfWholeNumbersTakeManyCopies) {
    const std::vector<WrittenReading> few(3, width_row("0", 6, 0.01)), many(100, few[0]);
    EXPECT_THAT(copied_rows(few), testing::Each(false));
    const std::vector<bool> copies = copied_rows(many);
    EXPECT_FALSE(copies[0]);
    EXPECT_EQ(std::count(copies.begin(), copies.end(), true), 99);
}

TEST(CopiedRows, CountOnceAndAreSaidToBeCopies) {
    Stone stone;
    stone.solid = make_cut("round-brilliant");
    std::vector<WrittenReading> rows(40, width_row("0", 6.5204, 0.01));
    std::vector<std::string> notes;
    EXPECT_EQ(bind_readings(rows, stone, &notes).size(), 1u);
    ASSERT_EQ(notes.size(), 1u);
    EXPECT_THAT(notes[0], test::says("39 rows repeat", "copies", "count once"));
}

}  // namespace
}  // namespace culet
