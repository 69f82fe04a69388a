// culet view as a user runs it: a page, its content, what it refuses.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/app/program_test.h"

namespace culet {
namespace {

using Json = nlohmann::json;
using test::ProgramRun;
using test::run_culet;
using ::testing::HasSubstr;

class ViewCommand : public test::ProgramTest {
protected:
    Json document(const std::string& name) const {
        const std::string page = text(name), start = "id=\"culet-document\">";
        const std::size_t from = page.find(start) + start.size();
        return Json::parse(page.substr(from, page.find("</script>", from) - from));
    }
};

TEST_F(ViewCommand, MakesAPageOfACutByItsName) {
    const ProgramRun run = run_culet({"view", "round-brilliant", "-o", file("a.html")});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_EQ(run.out, "");
    EXPECT_THAT(run.err, HasSubstr("a.html"));
    const Json page = document("a.html");
    EXPECT_EQ(page.at("schema"), "culet-view-1");
    const Json& stone = page.at("items").at(0).at("stones").at(0);
    EXPECT_EQ(stone.at("role"), "design");
    EXPECT_EQ(stone.at("material").at("id"), "diamond");
    EXPECT_EQ(stone.at("cut").at("kind"), "round-brilliant");
    // The picture stands in the page once.
    EXPECT_EQ(page.at("items").at(0).at("picture"), "");
    EXPECT_THAT(text("a.html"), HasSubstr("src=\"data:image/png;base64,"));
    // Nothing is fetched: the page contains no addresses but those of namespaces.
    EXPECT_EQ(text("a.html").find("https://"), std::string::npos);
}

TEST_F(ViewCommand, IsTheSameBytesEachTime) {
    for (const char* page : {"a.html", "b.html"})
        ASSERT_EQ(run_culet({"view", "step", "-q", "-o", file(page)}).exit_code, 0);
    EXPECT_EQ(text("a.html"), text("b.html"));
}

TEST_F(ViewCommand, CarriesWhatAFitSays) {
    cut("step", "start.obj");
    ASSERT_EQ(
        run_culet({"cut", "step", "--width", "6.4mm", "-o", file("fitted.obj"), "-q"}).exit_code,
        0);
    write("fit.json",
          R"({"status": "converged", "facets": [{"name": "T", "inclination": 0.5, "azimuth": 20,
             "sigma_inclination": 0.1, "sigma_azimuth": 3}],
             "readings": [{"id": "r0", "of": ["T"], "normalized": -2.5, "suspect": true}],
             "undetermined": [{"facet": "G1", "freedom": "offset"}], "suspects": ["r0"]})");
    const ProgramRun run =
        run_culet({"view", file("fitted.obj"), "--material", "sapphire_blue", "--report",
                   file("fit.json"), "--before", file("start.obj"), "-o", file("fit.html")});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const Json item = document("fit.html").at("items").at(0);
    ASSERT_EQ(item.at("stones").size(), 2u);
    EXPECT_EQ(item.at("stones")[0].at("role"), "catalogue");
    const Json& fitted = item.at("stones")[1];
    EXPECT_EQ(fitted.at("role"), "fitted");
    bool seen = false;
    for (std::size_t f = 0; f < fitted.at("facets").size(); ++f) {
        if (fitted.at("facets")[f].at("name") != "T") continue;
        seen = true;
        const Json& facts = fitted.at("fit")[f];
        EXPECT_EQ(facts.at("inclination_deg"), 0.5);
        EXPECT_EQ(facts.at("residual"), -2.5);
        EXPECT_EQ(facts.at("reading"), "r0");
        EXPECT_EQ(facts.at("suspect"), true);
    }
    EXPECT_TRUE(seen);
    write("other.json", R"({"facets": [{"name": "nobody"}]})");
    const ProgramRun other = run_culet({"view", file("fitted.obj"), "--material", "diamond",
                                        "--report", file("other.json"), "-o", file("x.html")});
    EXPECT_EQ(other.exit_code, 2);
    EXPECT_FALSE(std::filesystem::exists(folder_ / "x.html"));
}

TEST_F(ViewCommand, MakesAGalleryOfAFolderAndNamesWhatItLeavesOut) {
    std::filesystem::create_directory(folder_ / "stones");
    cut("step", "stones/b.obj");
    cut("princess", "stones/a.asc");
    write("stones/broken.obj", "v 0 0 0\nf 1 2 3\n");
    write("stones/broken.toml", "[stone\n");
    write("stones/notes.txt", "nothing to see\n");
    const ProgramRun run =
        run_culet({"view", file("stones"), "--material", "garnet_pyrope", "-o", file("g.html")});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_THAT(run.err, HasSubstr("broken.obj"));
    EXPECT_THAT(run.err, HasSubstr("broken.toml"));
    const Json items = document("g.html").at("items");
    ASSERT_EQ(items.size(), 2u);
    EXPECT_EQ(items[0].at("name"), "a.asc");
    EXPECT_EQ(items[1].at("name"), "b.obj");
}

TEST_F(ViewCommand, SaysWhatItDoesNotDraw) {
    cut("step", "stone.obj");
    write(
        "ball.toml",
        "mesh = \"stone.obj\"\nmaterial = \"diamond\"\n[light]\nconstant = 1\n[[object]]\nshape = "
        "\"sphere\"\ncenter = [9, 0, 0]\nradius = 1\nmaterial = { kind = \"diffuse\" }\n"
        "[camera]\nsize = [40, 40]\n[render]\nsamples = 4\n");
    const ProgramRun run = run_culet({"view", file("ball.toml"), "-o", file("ball.html")});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_THAT(run.err, HasSubstr("does not turn"));
    EXPECT_NE(document("ball.html").at("items")[0].at("refused"), "");
}

TEST_F(ViewCommand, RefusesInOneLineAndWritesNothing) {
    for (const std::vector<std::string>& words : {std::vector<std::string>{"view", "nowhere.obj"},
                                                  {"view", "round-brillant"},
                                                  {"view", "step", "--material", "unobtainium"},
                                                  {"view", "step", "--light", "moon"},
                                                  {"view", folder_.path().string()}}) {
        std::vector<std::string> all = words;
        all.insert(all.end(), {"-o", file("none.html")});
        refusal(all);
        EXPECT_FALSE(std::filesystem::exists(folder_ / "none.html"));
    }
}

}  // namespace
}  // namespace culet
