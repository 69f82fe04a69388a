// Files of outlines: their meaning, and what is refused.

#include "fit/readings/silhouette_tables.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fit/silhouettes/contour_files.h"
#include "fit/silhouettes/silhouette.h"
#include "stone/text/errors.h"
#include "stone/text/output_file.h"
#include "tests/folder_test.h"

namespace culet {
namespace {

using testing::HasSubstr;

class SilhouetteFiles : public test::FolderTest {
protected:
    std::filesystem::path file(const std::string& name, const std::string& text) const {
        write_text(folder_ / name, text);
        return folder_ / name;
    }
    std::string refusal(const std::string& json) const {
        try {
            read_contours(file("contours.json", json), LengthUnit::mm);
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    }
};

// A triangle has three sides, each sampled at the two points of Gauss's rule: 0.2113 and 0.7887 of
// the way.
TEST_F(SilhouetteFiles, APolygonOfFewCornersIsOneOfSides) {
    const auto contours =
        read_contours(file("contours.json", R"({"unit": "cm", "contours": [{"direction": [0, 0, 2],
            "points": [[0, 0, 5], [1, 0, 5], [0, 1, 5]], "sigma": 0.001, "weight": 4}]})"),
                      LengthUnit::mm);
    ASSERT_EQ(contours.size(), 1u);
    ASSERT_EQ(contours[0].points.size(), 6u);
    EXPECT_DOUBLE_EQ(contours[0].direction.z, 1);
    EXPECT_NEAR(contours[0].points[0].x, 10 * (0.5 - std::sqrt(1.0 / 12)), 1e-12);
    EXPECT_DOUBLE_EQ(contours[0].sigma, 0.01);
    EXPECT_DOUBLE_EQ(contours[0].weights[0], 4);
}

TEST_F(SilhouetteFiles, RefusalsSayWhatIsWrongAndWhere) {
    EXPECT_THAT(refusal("{"), HasSubstr("not JSON"));
    EXPECT_THAT(refusal("[]"), HasSubstr("no list `contours`"));
    EXPECT_THAT(refusal(R"({"contours": []})"), HasSubstr("holds no contour"));
    EXPECT_THAT(refusal(R"({"contours": [3]})"), HasSubstr("contour 0"));
    EXPECT_THAT(refusal(R"({"unit": "ell", "contours": [{}]})"), HasSubstr("unit is \"ell\""));
    EXPECT_THAT(refusal(R"({"contours": [{"direction": [0,0,0], "points": [[0,0,0],[1,0,0],
        [0,1,0]]}]})"),
                HasSubstr("zero vector"));
    EXPECT_THAT(refusal(R"({"contours": [{"direction": [0,0,1], "points": [[0,0,0],[1,0,0]]}]})"),
                HasSubstr("three points"));
    EXPECT_THAT(refusal(R"({"contours": [{"direction": [0,0,1], "points": [[0,0,0],[0,0,1],
        [0,0,2]]}]})"),
                HasSubstr("all points of an outline are one"));
    EXPECT_THAT(refusal(R"({"contours": [{"direction": [0,0,1], "points": "no"}]})"),
                HasSubstr("`points`"));
    EXPECT_THAT(refusal(R"({"contours": [{"direction": [0,0,1], "sigma": -1, "points":
        [[0,0,0],[1,0,0],[0,1,0]]}]})"),
                HasSubstr("`sigma`"));
}

TEST_F(SilhouetteFiles, AScannersSidesOfNoConfidenceAreLeftOut) {
    const std::string text =
        "# num_shadow_contours\r\n 1\r\n\r\n 3 1 0 0\r\n"
        "1.0 0\r\n 0 0 0\r\n 0 1 0\r\n 1.0 0\r\n 0 1 0\r\n 0 0 3\r\n 0.0 4\r\n 0 0 3\r\n 0 0 0\r\n";
    const ShadowContours read = read_shadow_contours(file("shadow.dat", text), LengthUnit::mm);
    ASSERT_EQ(read.contours.size(), 1u);
    EXPECT_EQ(read.sides_left_out, 1);
    ASSERT_EQ(read.contours[0].points.size(), 4u);
    // Weights are proportional to the square root of the length, with mean one: 1 and 10 to the
    // power 1/4.
    EXPECT_NEAR(read.contours[0].weights[2] / read.contours[0].weights[0], std::pow(10, 0.25),
                1e-12);
    EXPECT_NEAR(read.contours[0].weights[0] + read.contours[0].weights[2], 2, 1e-12);
    for (std::size_t cut = 0; cut + 3 < text.size(); cut += 7) {
        EXPECT_THROW(read_shadow_contours(file("cut.dat", text.substr(0, cut)), LengthUnit::mm),
                     InputError);
    }
    EXPECT_THROW(read_shadow_contours(file("bad.dat", "1e9"), LengthUnit::mm), InputError);
    EXPECT_THROW(read_shadow_contours(file("bad.dat", "1 3 1 0 nan"), LengthUnit::mm), InputError);
}

TEST_F(SilhouetteFiles, ATableHoldsEveryNthOutlineOut) {
    std::string contours;
    for (int k = 0; k < 5; ++k) {
        contours += std::string(k == 0 ? "" : ",") +
                    R"({"direction": [1,0,0], "points": [[0,0,0],[0,1,0],[0,0,1]]})";
    }
    file("contours.json", "{\"contours\": [" + contours + "]}");
    const auto toml =
        file("stone.toml",
             "[stone]\nmesh = \"none.obj\"\n[[silhouette]]\nfile = \"contours.json\"\n"
             "frame = \"free\"\nhold_out = 2\n");
    const auto written = read_silhouettes(read_toml(toml));
    ASSERT_EQ(written.size(), 1u);
    EXPECT_EQ(written[0].outlines->contours.size(), 3u);
    EXPECT_EQ(written[0].outlines->held_out.size(), 2u);
    EXPECT_TRUE(written[0].outlines->is_free);
    EXPECT_THROW(read_silhouettes(read_toml(toml, {"silhouette.0.hold_out=1"})), InputError);
    EXPECT_THROW(read_silhouettes(read_toml(toml, {"silhouette.0.sigma=-1"})), InputError);
    EXPECT_THROW(read_silhouettes(read_toml(toml, {"silhouette.0.frame=mine"})), InputError);
    EXPECT_THROW(read_silhouettes(read_toml(toml, {"silhouette.0.format=png"})), InputError);
}

}  // namespace
}  // namespace culet
