// The photograph, over a real socket. Expectations: docs/studio.md, "Photograph".

#include <cmath>
#include <set>

#include "render/image/image_io.h"
#include "tests/studio/studio_over_the_network.h"

namespace culet {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

class StudioPhotograph : public StudioOverTheNetwork {
protected:
    Json photograph() const { return Json::parse(get("/api/photograph", cookie_)->body); }
    int ask(const std::string& what, Json body) const {
        body["opened"] = photograph()["opened"];
        return post("/api/photograph/" + what + "?window=w", body.dump(), cookie_)->status;
    }
    httplib::Result upload(const std::string& name, const std::string& bytes) const {
        return post("/api/photograph/upload?window=w&name=" + name, bytes, cookie_);
    }
    /// When `ready` holds of it.
    Json when(const std::function<bool(const Json&)>& ready) const {
        for (int i = 0; i < 2400; ++i) {
            Json now = photograph();
            if (ready(now)) return now;
            std::this_thread::sleep_for(std::chrono::milliseconds(50));
        }
        return {};
    }
    Json at_rest() const {
        return when([](const Json& now) { return now["phase"] == ""; });
    }
    std::set<std::string> files() const {
        std::set<std::string> names;
        for (const auto& entry : fs::directory_iterator(folder_.path()))
            names.insert(entry.path().filename().string());
        return names;
    }
    static std::string picture() {
        Picture picture;
        picture.width = picture.height = 64;
        picture.rgb.assign(3 * picture.pixels(), 0.5f);
        return png_of(picture, {});
    }
};

// The sample's photograph is 1.0 degrees from its scene's camera, which looks straight down, and
// matches (docs/photograph-against-render.md).
TEST_F(StudioPhotograph, IsLaidUnderItsStoneAndCompared) {
    fs::copy(fs::path(CULET_SOURCE_DIR) / "samples" / "dravite-step", folder_ / "dravite");
    const std::string stone = (fs::canonical(folder_ / "dravite") / "stone.toml").string();
    ASSERT_EQ(
        post("/api/begin/open", Json{{"recent", false}, {"file", stone}}.dump(), cookie_)->status,
        200);
    ASSERT_EQ(fit()["fit"]["status"], "converged");
    EXPECT_EQ(photograph()["files"], Json({"simulated-photo.png"}));
    ASSERT_EQ(ask("open", {{"file", "simulated-photo.png"}}), 200);
    const Json begun = photograph();
    EXPECT_EQ(begun["light"], "") << "the scene of job.toml";
    EXPECT_EQ(begun["about"]["width"], 480);
    const auto shown = get("/api/photograph/photo.png", cookie_);
    EXPECT_EQ(shown->get_header_value("Content-Type"), "image/png");
    EXPECT_EQ(picture_of_bytes(shown->body, "a.png").picture.width, 480);
    const Json laid = when([](const Json& now) { return now["card_html"] != ""; });
    EXPECT_TRUE(laid["found"].get<bool>()) << laid["card_html"];
    const auto turn = laid["view"]["turn"].get<std::vector<double>>();
    EXPECT_LT(std::acos(std::min(1.0, -turn[8])), 0.07) << "from straight down, 4 degrees";
    // The first picture, before views nearby are drawn.
    std::string html;
    when([&](const Json&) {
        html = Json::parse(get("/api/photograph/report", cookie_)->body)["html"];
        return !html.empty();
    });
    EXPECT_NE(html.find("class=\"slider\""), std::string::npos);
    EXPECT_NE(html.find("Simulated photograph."), std::string::npos);
    EXPECT_EQ(html.find("<script"), std::string::npos);
    EXPECT_EQ(ask("cancel", {}), 200);
    at_rest();
    // A start that is off by a tenth of the stone and by 3 degrees, as of a hand.
    Json moved = laid["view"];
    moved["at"][0] = moved["at"][0].get<double>() + 20;
    moved["turn"] = {0.9986, 0.0523, 0, 0.0523, -0.9986, 0, 0, 0, -1};
    ASSERT_EQ(ask("lay",
                  {{"view", moved}, {"placed", true}, {"by_hand", false}, {"light", "photograph"}}),
              200);
    const Json again = when([](const Json& now) { return now["card_html"] != ""; });
    EXPECT_TRUE(again["found"].get<bool>()) << again["card_html"];
    for (int i = 0; i < 2; ++i)
        EXPECT_NEAR(again["view"]["at"][i].get<double>(), laid["view"]["at"][i].get<double>(), 3);
    EXPECT_EQ(ask("cancel", {}), 200);
}

TEST_F(StudioPhotograph, OfSomethingElseIsRefusedInWords) {
    ASSERT_EQ(upload("grey.png", picture())->status, 200);
    const Json laid = at_rest();
    EXPECT_FALSE(laid["found"].get<bool>());
    EXPECT_NE(laid["card_html"].get<std::string>().find("Not laid on"), std::string::npos);
    EXPECT_EQ(laid["card_html"].get<std::string>().find("--"), std::string::npos)
        << "an option of the command line";
    EXPECT_EQ(laid["files"], Json({"grey.png"}));
    // What is no view of a stone.
    for (const char* view : {"{}", "[]",
                             "{\"turn\":[0,0,0,0,0,0,0,0,0],\"at\":[0,0],\"sight\":[0,0],"
                             "\"scale\":1,\"nearness\":0}"}) {
        ask("lay", {{"view", Json::parse(view)},
                    {"placed", true},
                    {"by_hand", true},
                    {"light", "photograph"}});
        EXPECT_NE(at_rest()["trouble"], Json()) << view;
    }
    ask("lay", {{"view", laid["view"]}, {"placed", false}, {"by_hand", false}, {"light", "../x"}});
    EXPECT_NE(at_rest()["trouble"], Json());
    EXPECT_EQ(ask("lay", Json::object()), 400);
}

TEST_F(StudioPhotograph, UploadsStayInTheFolderUnderPlainNames) {
    ASSERT_EQ(upload("..%2F..%2Fescaped.png", picture())->status, 200);
    EXPECT_TRUE(files().contains("escaped.png"));
    EXPECT_EQ(upload("escaped.png", picture())->status, 200);
    EXPECT_FALSE(files().contains("escaped-2.png")) << "this very picture again";
    // A link of that name is not written through.
    const test::ScratchFolder elsewhere;
    std::ofstream(elsewhere / "other.png") << "kept";
    fs::create_symlink(elsewhere / "other.png", folder_ / "link.png");
    EXPECT_EQ(upload("link.png", picture())->status, 200);
    EXPECT_EQ(fs::file_size(elsewhere / "other.png"), 4u);
    EXPECT_TRUE(files().contains("link-2.png"));
    // What is no picture, or half of one, leaves nothing behind.
    const std::set<std::string> before = files();
    for (const auto& [name, bytes] : std::map<std::string, std::string>{
             {"words.jpg", "no picture"},
             {"raw.cr2", "no raw file"},
             {"phone.heic", "not read here"},
             {"program.sh", "rm -rf /"},
             {"empty.png", ""},
             {"half.png", picture().substr(0, 60)},
             {"half.jpg", "\xff\xd8\xff\xe0" + std::string(12, 'x')}}) {
        const auto answer = upload(name, bytes);
        EXPECT_EQ(answer->status, 400) << name;
        const std::string trouble = Json::parse(answer->body)["trouble"];
        EXPECT_EQ(trouble.find('\n'), std::string::npos);
        EXPECT_NE(trouble.find(name), std::string::npos) << trouble;
        EXPECT_EQ(trouble.find(folder_.path().string()), std::string::npos) << trouble;
    }
    EXPECT_EQ(files(), before);
    EXPECT_EQ(get("/api/state", cookie_)->status, 200);
}

TEST_F(StudioPhotograph, ReadsNothingOutsideOfTheFolder) {
    const test::ScratchFolder elsewhere;
    std::ofstream(elsewhere / "secret.png", std::ios::binary) << picture();
    fs::create_symlink(elsewhere / "secret.png", folder_ / "link.png");
    const std::string up = "../" + elsewhere.path().filename().string() + "/secret.png";
    for (const std::string& name :
         {up, std::string("link.png"), (elsewhere / "secret.png").string()})
        EXPECT_EQ(ask("open", {{"file", name}}), 400) << name;
    write("job.toml", "[fit]\nstone = \"stone.toml\"\n[compare]\nphoto = \"" + up + "\"\n");
    EXPECT_NE(photograph()["trouble"].get<std::string>().find("outside"), std::string::npos);
    EXPECT_EQ(get("/api/photograph/photo.png", cookie_)->status, 400);
    EXPECT_EQ(get("/api/photograph", {})->status, 403);
    EXPECT_EQ(get("/api/photograph/../../stone.toml", cookie_)->status, 400);
}

TEST_F(StudioPhotograph, TooLargeAnUploadIsRefusedUnread) {
    expect_too_large("/api/photograph/upload?name=large.jpg");
    EXPECT_FALSE(files().contains("large.jpg"));
}

}  // namespace
}  // namespace culet
