// The bench and the files that are made, over a real socket. Expectations: docs/studio.md.

#include <set>

#include "render/image/image_io.h"
#include "stone/gemcad/gemcad_io.h"
#include "tests/studio/studio_over_the_network.h"

namespace culet {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

class StudioFiles : public StudioOverTheNetwork {
protected:
    Json bench() const { return Json::parse(get("/api/bench", cookie_)->body); }
    int mark(int step, const std::string& tier, bool done) const {
        const Json body{
            {"opened", table()["opened"]}, {"step", step}, {"tier", tier}, {"done", done}};
        return post("/api/bench/mark?window=w", body.dump(), cookie_)->status;
    }
    int make(const std::string& kind) const {
        const Json body{{"opened", table()["opened"]}, {"kind", kind}};
        return post("/api/export/make?window=w", body.dump(), cookie_)->status;
    }
    Json made() const {
        for (int i = 0; i < 1200; ++i) {
            Json now = Json::parse(get("/api/export", cookie_)->body);
            if (!now["runs"].get<bool>()) return now;
            std::this_thread::sleep_for(std::chrono::milliseconds(50));
        }
        return {};
    }
    std::set<std::string> files() const {
        std::set<std::string> names;
        for (const auto& entry : fs::recursive_directory_iterator(folder_.path()))
            names.insert(entry.path().string());
        return names;
    }
};

TEST_F(StudioFiles, MakesEveryKindAndWritesNothing) {
    EXPECT_EQ(edit(3, "value", "33.8"), 200);
    EXPECT_EQ(fit()["fit"]["status"], "converged");
    const std::set<std::string> before = files();
    const std::size_t facets = make_cut("round-brilliant").facets.size();
    for (const auto& [kind, begin] : std::map<std::string, std::string>{{"html", "<!doctype html>"},
                                                                        {"png", "\x89PNG"},
                                                                        {"obj", "# culet"},
                                                                        {"ply", "ply"},
                                                                        {"stl", "solid"},
                                                                        {"3mf", "PK"},
                                                                        {"glb", "glTF"},
                                                                        {"step", "ISO-10303-21"},
                                                                        {"asc", "GemCad"},
                                                                        {"gcs", "<GemCutStudio"}}) {
        ASSERT_EQ(make(kind), 200);
        const Json now = made();
        EXPECT_EQ(now["trouble"], "") << kind;
        EXPECT_EQ(now["file"], "_b_bold__b_." + kind);
        const auto answer = get("/api/export/file", cookie_);
        EXPECT_EQ(answer->get_header_value("Content-Disposition"),
                  "attachment; filename=\"_b_bold__b_." + kind + "\"");
        EXPECT_EQ(answer->get_header_value("Content-Type"), "application/octet-stream");
        EXPECT_TRUE(answer->body.starts_with(begin)) << answer->body.substr(0, 40);
        const std::string& bytes = answer->body;
        if (kind == "obj") {
            EXPECT_EQ(parse_mesh(bytes, MeshFormat::obj).solid.facets.size(), facets);
        } else if (kind == "asc") {
            EXPECT_EQ(parse_gemcad_asc(bytes).solid.facets.size(), facets);
        } else if (kind == "png") {
            EXPECT_GT(picture_of_bytes(bytes, "a.png").picture.pixels(), 0u);
        } else if (kind == "html") {
            EXPECT_EQ(bytes.find("<b>bold"), std::string::npos) << "a name from a file became HTML";
        }
    }
    EXPECT_EQ(files(), before);
}

TEST_F(StudioFiles, SaysWhatAFormatLosesAndWhatIsWrong) {
    make("asc");
    const std::string notes = made()["notes"].dump();
    EXPECT_NE(notes.find("no design"), std::string::npos) << notes;
    EXPECT_EQ(notes.find("--material"), std::string::npos) << "an option of the command line";
    make("sh");
    EXPECT_NE(made()["trouble"].get<std::string>().find("no kind"), std::string::npos);
    EXPECT_EQ(get("/api/export/file", cookie_)->status, 400);
    EXPECT_EQ(post("/api/export/make", "{}", cookie_)->status, 400);
    EXPECT_EQ(get("/api/export/file", {})->status, 403);
}

TEST_F(StudioFiles, APictureIsStoppedAndKeepsNoFitWaiting) {
    EXPECT_EQ(make("png"), 200);
    EXPECT_EQ(make("obj"), 400) << "one at a time";
    EXPECT_EQ(edit(3, "value", "33.8"), 200);
    EXPECT_EQ(post("/api/export/cancel", "{}", cookie_)->status, 200);
    EXPECT_EQ(made()["trouble"], "stopped");
    EXPECT_EQ(fit()["fit"]["status"].is_string(), true);
    EXPECT_EQ(make("obj"), 200);
    EXPECT_EQ(made()["trouble"], "");
}

// Steps as tests/page/cutting_sheet_test.cpp has them for this cut.
TEST_F(StudioFiles, TheBenchKeepsItsMarks) {
    Json steps = bench()["drawn"]["steps"];
    ASSERT_EQ(steps.size(), 7u);
    EXPECT_EQ(steps[2]["tier"], "G");
    EXPECT_EQ(steps[2]["angle"], "90.00");
    EXPECT_EQ(steps[2]["facets"].size(), 16u);
    EXPECT_FALSE(steps[2]["done"].get<bool>());
    EXPECT_NE(bench()["drawn"]["note"].get<std::string>().find(".asc"), std::string::npos);
    heard("bench", [&] { EXPECT_EQ(mark(3, "G", true), 200); });
    EXPECT_EQ(mark(1, "L", true), 200);
    EXPECT_EQ(text("stone-bench.txt"), "01 L\n03 G\n");
    end();
    start();
    EXPECT_TRUE(bench()["drawn"]["steps"][2]["done"].get<bool>());
    EXPECT_EQ(mark(3, "G", false), 200);
    EXPECT_EQ(text("stone-bench.txt"), "01 L\n");
    // Lines of another program are kept, and shown.
    heard("bench", [&] { write("stone-bench.txt", "01 L\n02 P\n99 X\n"); });
    EXPECT_EQ(mark(1, "L", false), 200);
    EXPECT_EQ(text("stone-bench.txt"), "02 P\n99 X\n");
    EXPECT_TRUE(bench()["drawn"]["steps"][1]["done"].get<bool>());
    EXPECT_EQ(edit(3, "value", "33.8"), 200);
    fit();
    EXPECT_NE(bench()["fitted"]["steps"][4]["angle"].get<std::string>().find(" ± "),
              std::string::npos);
}

// A design has no size, so lengths are in widths (docs/stone-files.md).
TEST_F(StudioFiles, ADesignHasNoMillimetresBeforeAFit) {
    make("asc");
    made();
    const std::string design = get("/api/export/file", cookie_)->body;
    EXPECT_EQ(post("/api/begin/upload?name=design.asc", design, cookie_)->status, 200);
    const Json sheet = bench()["drawn"];
    EXPECT_EQ(sheet["note"], "");
    EXPECT_EQ(sheet["steps"].dump().find("mm"), std::string::npos) << sheet["steps"];
    EXPECT_EQ(sheet["about"].get<std::string>().find("--width"), std::string::npos);
    EXPECT_EQ(bench().count("fitted"), 0u);
}

TEST_F(StudioFiles, MarksStayInTheFolder) {
    const test::ScratchFolder elsewhere;
    std::ofstream(elsewhere / "marks.txt") << "kept\n";
    bench();
    fs::create_symlink(elsewhere / "marks.txt", folder_ / "stone-bench.txt");
    EXPECT_EQ(mark(1, "L", true), 400);
    const auto answer = get("/api/bench", cookie_);
    EXPECT_EQ(answer->status, 400);
    EXPECT_EQ(answer->body.find("kept"), std::string::npos);
    std::ifstream kept(elsewhere / "marks.txt");
    std::string line;
    EXPECT_TRUE(std::getline(kept, line) && line == "kept");
}

}  // namespace
}  // namespace culet
