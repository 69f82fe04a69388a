#include "stone/design/design_difference.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "stone/gemcad/gemcad_io.h"
#include "tests/stone/made_designs.h"

namespace culet {
namespace {

using namespace culet::test;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::vector<std::string> differences(const std::string& a, const std::string& b) {
    std::vector<std::string> words;
    for (const DesignDifference& one :
         design_differences(parse_gemcad_asc(a).solid, parse_gemcad_asc(b).solid))
        words.push_back(words_of(one));
    return words;
}

TEST(DesignDifferences, AreSaidAsACutterWould) {
    const std::string text = text_of({.instruction = "Cut"});
    const auto with = [&](const std::string& old, const std::string& now) {
        std::string other = text;
        const std::size_t at = other.find(old);
        EXPECT_NE(at, std::string::npos) << old;
        return other.replace(at, old.size(), now);
    };
    EXPECT_THAT(differences(text, text), IsEmpty());
    EXPECT_THAT(differences(text, with("I 1.76", "I 1.54")),
                ElementsAre("refractive index: 1.76, then 1.54"));
    EXPECT_THAT(differences(text, with("y 8 y", "y 4 n")),
                ElementsAre("symmetry: 8-fold, mirrored, then 4-fold"));
    EXPECT_THAT(differences(text, with("n P ", "n Q ")), ElementsAre("P: name: P, then Q"));
    EXPECT_THAT(differences(text, with("G Cut S", "G Meet S")),
                ElementsAre("S: instruction: Cut S, then Meet S"));
    EXPECT_THAT(differences(text, with("0.3 0 n T", "0.25 0 n T")),
                ElementsAre("T: depth: as before, then 0.02500 W deeper"));
    EXPECT_THAT(differences(text, with("a 34 ", "a 34.5 ")),
                ElementsAre("C: angle: 34, then 34.5"));
    const std::string table = "a 0.000000 0.3 0 n T\n";
    EXPECT_THAT(differences(text, with(table, table + "a 20 0.32 96 n X 48\n")),
                ElementsAre("X: tier: none, then 20.00 degrees crown, index 96 48"));
    std::string moved = with(table, "");
    moved.insert(moved.find("a -41.25"), table);
    EXPECT_THAT(differences(text, moved),
                ElementsAre("order of cutting: P B G C S T, then T P B G C S"));
}

// The same stone on another wheel: each index is two thirds; and at another size.
TEST(DesignDifferences, AnotherWheelOrSizeIsNoOtherStone) {
    EXPECT_THAT(differences(text_of({.gear = 96}), text_of({.gear = 64})),
                ElementsAre("gear: 96, then 64"));
    const Solid solid = parse_gemcad_asc(text_of({})).solid;
    Solid large = solid;
    for (Vec3& v : large.vertices) v *= 3.25;
    for (Facet& facet : large.facets) facet.plane.offset *= 3.25;
    EXPECT_THAT(design_differences(solid, large), IsEmpty());
}

}  // namespace
}  // namespace culet
