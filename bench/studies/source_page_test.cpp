#include "bench/studies/source_page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bench/studies/source_studies.h"
#include "stone/text/errors.h"

namespace culet {
namespace {

using testing::HasSubstr;

TEST(SourcePage, HasItsPartsInOrderAndItsParameters) {
    SourcePage page("some", "A <title>", "Somebody");
    page.section("First");
    page.words("Words & words");
    page.table("Numbers", {"what", "value"}, {{"row", "1.50"}});
    page.learned("A lesson");
    const std::string whole = page.html({{"pixels", "20"}}),
                      html = whole.substr(whole.find("<main"));
    EXPECT_THAT(html, HasSubstr("A &lt;title&gt;"));
    EXPECT_THAT(html, HasSubstr("Words &amp; words"));
    EXPECT_LT(html.find("Words"), html.find("1.50"));
    EXPECT_LT(html.find("1.50"), html.find("A lesson"));
    EXPECT_LT(html.find("A lesson"), html.find("pixels"));
    EXPECT_THAT(html, HasSubstr("bench/studies.sh some"));
}

TEST(SourcePage, APictureIsInThePageItself) {
    SourcePage page("some", "title", "source");
    page.section("First");
    Picture picture;
    picture.width = picture.height = 4;
    picture.rgb.assign(48, 0.5f);
    page.pictures({{"grey", picture, {}}});
    EXPECT_THAT(page.html({}), HasSubstr("src=\"data:image/jpeg;base64,/9j/"));
}

TEST(SourcePage, ARowWithACellTooFewIsAFaultOfOurs) {
    SourcePage page("some", "title", "source");
    page.section("First");
    EXPECT_THROW(page.table("Numbers", {"what", "value"}, {{"row"}}), InternalError);
}

TEST(StudyParameters, AreRememberedAsTheyAreAskedFor) {
    Parameters parameters(toml_of_text("a = 1.5\nb = 3\nc = [1, 2.5]\n", "parameters.toml"));
    EXPECT_EQ(parameters.count("b"), 3);
    EXPECT_EQ(parameters.number("a"), 1.5);
    EXPECT_EQ(parameters.numbers("c"), (std::vector<double>{1, 2.5}));
    EXPECT_EQ(parameters.number("a"), 1.5);
    EXPECT_EQ(parameters.used(),
              (std::vector<std::vector<std::string>>{{"b", "3"}, {"a", "1.5"}, {"c", "1, 2.5"}}));
}

TEST(StudyParameters, SayWhatIsMissing) {
    Parameters parameters(toml_of_text("a = 0\n", "parameters.toml"));
    EXPECT_THROW(parameters.number("missing"), InputError);
    EXPECT_THROW(parameters.count("a"), InputError);
}

TEST(StudyParameters, HaveATableForEveryStudy) {
    const TomlTable all = read_toml(CULET_SOURCE_DIR "/bench/studies/parameters.toml");
    for (const SourceStudy& study : source_studies())
        EXPECT_TRUE(all.table(study.name).has_value()) << study.name;
}

}  // namespace
}  // namespace culet
