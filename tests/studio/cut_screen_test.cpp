// The cut screen over a real socket. Expectations: docs/studio.md, and the affine scaling of a
// crown, which keeps every meet and changes all tangents by one factor.

#include <cmath>

#include "stone/numbers/units.h"
#include "stone/text/output_file.h"
#include "tests/studio/studio_over_the_network.h"

namespace culet {
namespace {

using Json = nlohmann::json;

class CutScreen : public StudioOverTheNetwork {
protected:
    void SetUp() override {
        more_ = "material = \"quartz\"\n";  // whose light leaves it sooner than a diamond's
        StudioOverTheNetwork::SetUp();
        ASSERT_EQ(fit()["runs"], false);
        now_ = Json::parse(get("/api/cut?window=w", cookie_)->body);
    }
    Json change(const std::string& what, Json body = Json::object()) {
        body["opened"] = now_["opened"];
        body["at"] = now_["at"];
        Json answer =
            Json::parse(post("/api/cut/" + what + "?window=w", body.dump(), cookie_)->body);
        if (answer.contains("now")) now_ = answer;
        return answer;
    }
    Json turn(const std::string& name, double value) {
        return change("change", {{"tier", place_of(name)}, {"value", value}});
    }
    std::size_t place_of(const std::string& name) const {
        for (std::size_t i = 0; i < now_["now"]["tiers"].size(); ++i) {
            if (now_["now"]["tiers"][i]["name"] == name) return i;
        }
        ADD_FAILURE() << name;
        return 0;
    }
    double value_of(const char* when, const std::string& name) const {
        return now_[when]["tiers"][place_of(name)]["value"].get<double>();
    }
    void wait() {
        for (int i = 0; i < 2400 && (now_["runs"] != "" || i == 0); ++i) {
            now_ = Json::parse(get("/api/cut?window=w", cookie_)->body);
            std::this_thread::sleep_for(std::chrono::milliseconds(50));
        }
    }
    Json now_;
};

TEST_F(CutScreen, ScalesACrownByOneFactorOfItsTangents) {
    const double height = value_of("start", "Height of the crown");
    turn("Height of the crown", 0.9 * height);
    EXPECT_NEAR(value_of("now", "Height of the crown"), 0.9 * height, 1e-6);
    for (const char* tier : {"S", "C", "U"}) {
        EXPECT_NEAR(std::tan(radians(value_of("now", tier))),
                    0.9 * std::tan(radians(value_of("start", tier))), 1e-6)
            << tier;
    }
    EXPECT_NEAR(value_of("now", "P"), value_of("start", "P"), 1e-9);
    EXPECT_EQ(change("undo")["undo"], "");
    EXPECT_NEAR(value_of("now", "C"), value_of("start", "C"), 1e-12);
    EXPECT_EQ(change("redo")["at"], 1);
}

TEST_F(CutScreen, GoesAsFarAsTheMeetsAllowAndSaysSo) {
    const double was = value_of("start", "P");
    const Json answer = turn("P", was + 20);
    EXPECT_GT(value_of("now", "P"), was + 0.05);
    EXPECT_LT(value_of("now", "P"), was + 20);
    EXPECT_NE(now_["undo"].get<std::string>().find("would lose a meet or a facet"),
              std::string::npos)
        << answer.dump();
    // A preview tries, and changes nothing.
    const Json before = now_;
    const Json shown = change("preview", {{"tier", place_of("C")}, {"value", 33}});
    EXPECT_TRUE(shown.contains("figures")) << shown.dump();
    EXPECT_EQ(Json::parse(get("/api/cut?window=w", cookie_)->body), before);
}

TEST_F(CutScreen, RefusesWhatAnotherWindowChangedAndWhatIsNoTier) {
    now_["at"] = 7;
    EXPECT_NE(change("undo")["trouble"].get<std::string>().find("another window"),
              std::string::npos);
    now_["at"] = 0;
    EXPECT_TRUE(change("change", {{"tier", 99}, {"value", 30}}).contains("trouble"));
    EXPECT_TRUE(turn("C", -5).contains("trouble"));
    EXPECT_TRUE(change("nothing").contains("trouble"));
    EXPECT_TRUE(change("optimise", {{"objective", "beauty"}, {"recut", false}, {"most_loss", 10}})
                    .contains("now"));
    wait();
    EXPECT_NE(now_["trouble"].get<std::string>().find("brilliance, fire, contrast"),
              std::string::npos)
        << now_["trouble"];
    EXPECT_EQ(get("/grade", cookie_)->status, 404);
}

TEST_F(CutScreen, GradesBothInAPageWithoutAnOrigin) {
    turn("Height of the crown", 0.95 * value_of("start", "Height of the crown"));
    change("grade");
    wait();
    EXPECT_EQ(now_["trouble"], "");
    ASSERT_EQ(now_["graded"], true);
    const auto page = get("/grade", cookie_);
    EXPECT_NE(page->body.find("As it is"), std::string::npos);
    EXPECT_NE(page->body.find("As tried"), std::string::npos);
    const std::string policy = page->get_header_value("Content-Security-Policy");
    EXPECT_TRUE(policy.starts_with("sandbox ")) << policy;
    EXPECT_EQ(policy.find("allow-same-origin"), std::string::npos);
    EXPECT_EQ(get("/grade", {})->status, 403);
}

TEST_F(CutScreen, IsStoppedAndThenChangesNothing) {
    const Json before = now_["now"];
    change("optimise", {{"objective", "brilliance"}, {"recut", true}, {"most_loss", 10}});
    EXPECT_EQ(now_["runs"], "optimise");
    change("stop");
    wait();
    EXPECT_EQ(now_["trouble"], "stopped");
    EXPECT_EQ(now_["now"], before);
}

TEST_F(CutScreen, IsKeptAsAStoneOfItsOwn) {
    turn("Height of the crown", 0.9 * value_of("start", "Height of the crown"));
    const double kept = value_of("now", "C");
    const std::string before = read_text(folder_ / "stone.toml");
    change("keep");
    const Json state = Json::parse(get("/api/state", cookie_)->body);
    const std::filesystem::path file = state["file"].get<std::string>();
    EXPECT_TRUE(file.parent_path().filename().string().ends_with("-recut")) << file;
    EXPECT_EQ(read_text(folder_ / "stone.toml"), before);
    const Json bench = Json::parse(get("/api/bench", cookie_)->body);
    bool found = false;
    for (const Json& step : bench["drawn"]["steps"]) {
        if (step["tier"] != "C") continue;
        found = true;
        EXPECT_NEAR(std::stod(step["angle"].get<std::string>()), kept, 0.006);
    }
    EXPECT_TRUE(found) << bench.dump();
}

}  // namespace
}  // namespace culet
