// [[line]] tables: what they mean, and what is refused.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "fit/fit.h"
#include "fit/readings/seen_lines.h"
#include "stone/mesh/mesh_io.h"
#include "stone/stone_io.h"
#include "stone/text/errors.h"
#include "tests/fit/test_stones.h"
#include "tests/folder_test.h"

namespace culet {
namespace {

using testing::HasSubstr;

class LineTables : public test::FolderTest {
protected:
    void SetUp() override {
        write_solid(test::cube(), folder_ / "cube.obj");
        write("spin.json", R"({"frames": [{"file": "f1.jpg", "projection":
            [[100, 0, 0, 300], [0, 0, -100, 300], [0, 0.1, 0, 1]]}, {"file": "f2.jpg"}]})");
    }
    std::string stone(const std::string& table) const {
        return write("stone.toml",
                     "[stone]\nmesh = \"cube.obj\"\nup = \"T\"\nmaterial = \"diamond\"\n"
                     "[[line]]\nid = \"edge\"\n" +
                         table);
    }
    std::string refusal(const std::string& table) const {
        const std::string file = stone(table);
        try {
            fit_input(read_stone(file).stone, read_readings(file));
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    }
};

TEST_F(LineTables, AFrameOfASpinOrAProjection) {
    const std::string points = "points = [[210, 200], [390, 200.5]]\nsigma = 0.3\n";
    const std::string of = "of = [\"T\", \"Y-\"]\n";
    const auto read = [&](const std::string& from) {
        const std::string file = stone(of + from + points);
        return fit_input(read_stone(file).stone, read_readings(file)).readings.at(0);
    };
    for (const char* from :
         {"file = \"spin.json\"\nframe = \"f1.jpg\"\n",
          "projection = [[100, 0, 0, 300], [0, 0, -100, 300], [0, 0.1, 0, 1]]\n"}) {
        const Reading line = read(from);
        EXPECT_EQ(line.kind, ReadingKind::line);
        EXPECT_EQ(line.id, "edge");
        ASSERT_TRUE(line.seen_line);
        EXPECT_EQ(line.seen_line->projection[1][2], 0.1);
        EXPECT_EQ(line.facets.size(), 2u);
        EXPECT_NEAR(line.sigma, 0.3 / std::sqrt(2.0), 1e-12);
        // At w = 0.9, along x and z.
        EXPECT_NEAR(line.pixels, 100 / 0.9, 5);
    }
}

TEST_F(LineTables, RefusalsSayWhatIsWrongAndWhere) {
    const std::string of = "of = [\"T\", \"Y-\"]\n", sigma = "sigma = 0.3\n",
                      points = "points = [[210, 200], [390, 200]]\n",
                      frame = "file = \"spin.json\"\nframe = \"f1.jpg\"\n";
    EXPECT_EQ(refusal(of + sigma + points + frame), "");
    const struct {
        std::string table;
        const char* what;
    } wrong[] = {
        {"of = [\"T\", \"B\"]\n" + sigma + points + frame, "share no edge"},
        {"of = [\"T\", \"T\"]\n" + sigma + points + frame, "twice"},
        {"of = [\"T\"]\n" + sigma + points + frame, "two facets of an edge"},
        {"of = [\"T\", \"Q\"]\n" + sigma + points + frame, "Q"},
        {of + sigma + points, "needs projection"},
        {of + sigma + points + "frame = \"f1.jpg\"\n", "needs projection"},
        {of + sigma + points + frame + "projection = [[1, 0, 0, 0]]\n", "needs projection"},
        {of + sigma + points + "file = \"spin.json\"\nframe = \"f3.jpg\"\n",
         "did you mean \"f1.jpg\""},
        {of + sigma + points + "file = \"cube.obj\"\nframe = \"f1.jpg\"\n", "culet spin"},
        {of + sigma + points + "projection = [[1, 0, 0, 0], [0, 1, 0, 0]]\n", "found 2"},
        {of + sigma + points + "projection = [[1, 0, 0]]\n", "must have four numbers, found 3"},
        {of + sigma + points + "projection = [[9, 0, 0, 0], [0, 0, 9, 0], [0, 0, 0, -1]]\n",
         "behind the eye"},
        {of + sigma + points + "projection = [[0, 0, 0, 0], [0, 0, 0, 0], [0, 0, 0, 1]]\n",
         "one pixel"},
        {of + sigma + frame, "two pixels or more, found 0"},
        {of + sigma + frame + "points = [[210, 200]]\n", "two pixels or more, found 1"},
        {of + sigma + frame + "points = [[210, 200], [210, 200]]\n", "one place"},
        {of + sigma + frame + "points = [[0, 0], [9, 0], [0, 9], [9, 9]]\n", "no line"},
        {of + sigma + frame + "points = [[210, 200, 1]]\n", "must have two numbers"},
        {of + points + frame, "sigma must be positive"},
        {of + points + frame + "sigma = 0\n", "sigma must be positive"},
        {of + points + frame + sigma + "sigmas = 1\n", "sigmas"},
    };
    for (const auto& [table, what] : wrong) {
        const std::string said = refusal(table);
        EXPECT_THAT(said, HasSubstr(what)) << table;
        const bool is_of_spin = what == std::string("culet spin");
        EXPECT_THAT(said, HasSubstr(is_of_spin ? "cube.obj" : "stone.toml:"));
    }
}

}  // namespace
}  // namespace culet
