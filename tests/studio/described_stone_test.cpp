// Words at the beginning. Expectations: the trade's length by width, and weight as volume times
// density.

#include "studio/described_stone.h"

#include <gtest/gtest.h>

#include "stone/cuts/cuts.h"
#include "stone/numbers/units.h"
#include "stone/text/errors.h"

namespace culet {
namespace {

using Values = std::map<std::string, double>;

struct Said {
    const char *text, *kind;
    Values values;
    const char* material;
};

TEST(DescribedStones, AreCutSizeProportionsAndMaterial) {
    const Said said[] = {
        {"9 x 7 oval, tourmaline", "oval", {{"width", 7}, {"ratio", 9. / 7}}, "tourmaline_dravite"},
        {"7x9mm Oval cut, blue sapphire",
         "oval",
         {{"width", 7}, {"ratio", 9. / 7}},
         "sapphire_blue"},
        {"6,5 mm brilliant, table 57 %, crown angle 34,5, diamond",
         "round-brilliant",
         {{"diameter", 6.5}, {"table", 57}, {"crown-angle", 34.5}},
         "diamond"},
        {"emerald cut, emerald, 8\xC3\x97"
         "6 mm",
         "step",
         {{"width", 6}, {"ratio", 8. / 6}},
         "emerald"},
        {"8x6 emerald-cut aquamarine", "step", {{"width", 6}, {"ratio", 8. / 6}}, "aquamarine"},
        {"A pear shape of 10 by 7 by 4.2 mm in citrine",
         "pear",
         {{"width", 7}, {"ratio", 10. / 7}},
         "citrine"},
        {"princess 5.2mm 41 \xC2\xB0 pavilion",
         "princess",
         {{"width", 5.2}, {"pavilion-depth", 41}},
         ""},
        {"marquise", "marquise", {}, ""},
        {"quartz", "round-brilliant", {}, "quartz"},
    };
    for (const Said& one : said) {
        const DescribedStone stone = described_stone(one.text);
        EXPECT_EQ(stone.kind, one.kind) << one.text;
        EXPECT_EQ(stone.values, one.values) << one.text;
        EXPECT_EQ(stone.material, one.material) << one.text;
    }
}

TEST(DescribedStones, HaveTheWeightThatIsSaid) {
    const DescribedStone stone = described_stone("2 ct round, diamond");
    const double weight = carat(volume(make_cut(stone.kind, stone.values)), 3.515);
    EXPECT_NEAR(weight, 2, 0.005);
    EXPECT_TRUE(stone.notes.empty());
    EXPECT_FALSE(described_stone("2 ct round").notes.empty()) << "no material was said";
}

TEST(DescribedStones, SayWhatWasNotUnderstood) {
    EXPECT_THROW(described_stone("hello"), InputError);
    EXPECT_THROW(described_stone(std::string(300, '9')), InputError);
    EXPECT_THROW(described_stone("900 x 7 oval"), InputError) << "no oval is that long";
    const DescribedStone stone = described_stone("oval, <b>bold</b>");
    EXPECT_EQ(stone.kind, "oval");
    EXPECT_EQ(stone.notes, std::vector<std::string>{"not understood: <b>bold</b>"});
    EXPECT_EQ(described_stone("oval of 9 by 7 by 4 mm").notes.size(), 1u);
}

}  // namespace
}  // namespace culet
