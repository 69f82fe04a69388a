// culet study and the drawings of culet fit as a user runs them.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/app/program_test.h"
#include "tests/page/xml.h"

namespace culet {
namespace {

namespace fs = std::filesystem;
using test::ProgramRun;
using test::run_culet;
using test::xml_fault;
using ::testing::HasSubstr;

class StudyCommand : public test::ProgramTest {
protected:
    static void expect_refused(const ProgramRun& run, const std::string& why) {
        EXPECT_THAT(refusal_of(run), HasSubstr(why));
    }
    // A cube with edges of 2: six facets, the four upright ones slightly tilted.
    void write_cube(const std::string& readings) const {
        write("cube.obj",
              "v 1 1 1\nv -1 1 1\nv -1 -1 1\nv 1 -1 1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 -1\nv 1 -1 "
              "-1\n"
              "g T\nf 1 2 3 4\ng B\nf 8 7 6 5\ng E\nf 1 4 8 5\ng N\nf 2 1 5 6\ng W\nf 3 2 6 7\n"
              "g S\nf 4 3 7 8\n");
        write("stone.toml",
              "[stone]\nname = \"Cube\"\nmesh = \"cube.obj\"\nunit = \"mm\"\nmaterial = "
              "\"diamond\"\nup = \"T\"\nreadings = \"readings.csv\"\n");
        std::ofstream(folder_ / "readings.csv") << "kind,of,value,sigma\n" << readings;
    }
    static std::string all_readings() {
        std::string text = "inclination,B,1.02,0.1\nazimuth,B,30.0,6\ndepth,,2.05,0.01\n";
        int k = 0;
        for (const char* name : {"E", "N", "W", "S"}) {
            text += "inclination," + std::string(name) + ",8" + std::to_string(6 + k % 3) +
                    ",0.1\nazimuth," + name + "," + std::to_string(90 * k) + ",0.1\n";
            ++k;
        }
        for (const char* edge : {"T/E", "T/N", "T/W", "T/S", "E/N", "N/W", "W/S", "S/E"}) {
            text += "edge," + std::string(edge) + ",2.0,0.2\n";
        }
        return text + "width,0,2.02,0.05\nwidth,90,2.02,0.05\n";
    }
    void write_scene() const {
        write("scene.toml",
              "stone = \"stone.toml\"\n[camera]\nposition = [6, 5, 9]\nsize = [80, 60]\n"
              "[light]\nconstant = 0.2\n[[light.lobe]]\ndirection = [0, 0, 1]\nexponent = 4\n"
              "[render]\ntolerance = 0.1\n");
    }
};

TEST_F(StudyCommand, WritesTablesChartsJsonAndPage) {
    write_cube(all_readings());
    const ProgramRun run = run_culet({"study", file("stone.toml"), "-o", file("out"), "--draws",
                                      "2", "--budget", "30", "--set", "fit.significance=1e-9"});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_THAT(run.out, HasSubstr("CPU/ms"));
    EXPECT_THAT(run.out, HasSubstr("limit/deg"));
    const auto json = this->json("out/study.json");
    EXPECT_EQ(json["schema"], 1);
    EXPECT_EQ(json["name"], "Cube");
    EXPECT_EQ(json["options"]["seed"], 1);
    EXPECT_FALSE(json["settings"].empty());
    EXPECT_FALSE(json["limits"].empty());
    EXPECT_EQ(xml_fault(text("out/time.svg")), "");
    EXPECT_EQ(xml_fault(text("out/limit.svg")), "");
    EXPECT_TRUE(text("out/time.csv").starts_with("sweep,setting,as_asked,"));
    EXPECT_TRUE(text("out/limit.csv").starts_with("readings,share,dof,"));
    EXPECT_THAT(text("out/report.html"), HasSubstr("<h1>Cube</h1>"));
}

TEST_F(StudyCommand, GivesItsJsonOnStdoutAlone) {
    write_cube(all_readings());
    const ProgramRun run = run_culet({"study", file("stone.toml"), "-o", file("out"), "--draws",
                                      "1", "--only", "limit", "--json", "-", "-q"});
    EXPECT_TRUE(nlohmann::json::accept(run.out)) << run.out;
    EXPECT_EQ(run.err, "");
    EXPECT_TRUE(nlohmann::json::parse(run.out)["settings"].empty());
}

TEST_F(StudyCommand, RefusesInOneLineAndWritesNothing) {
    write_cube("");
    expect_refused(run_culet({"study", file("stone.toml"), "-o", file("out")}), "no readings");
    expect_refused(run_culet({"study", file("none.toml"), "-o", file("out")}), "none.toml");
    EXPECT_FALSE(fs::exists(folder_ / "out"));
    write_cube(all_readings());
    expect_refused(run_culet({"study", file("stone.toml"), "-o", file("cube.obj")}), "is a file");
    expect_refused(run_culet({"study", file("stone.toml"), "-o", file("out"), "--draws", "0"}),
                   "--draws");
    expect_refused(run_culet({"study", file("stone.toml"), "-o", file("out"), "--budget", "-1"}),
                   "--budget");
}

TEST_F(StudyCommand, OfASceneWritesTablesChartJsonPicturesAndPage) {
    write_cube(all_readings());
    write_scene();
    const ProgramRun run =
        run_culet({"study", file("scene.toml"), "-o", file("out"), "--size", "16", "--runs", "2",
                   "--budget", "2", "--threads", "1", "-q"});
    EXPECT_LE(run.exit_code, 1) << run.err;
    EXPECT_EQ(run.err, "");
    EXPECT_THAT(run.out, HasSubstr("best setting"));
    EXPECT_THAT(run.out, HasSubstr("automatic settings took"));
    const auto json = this->json("out/study.json");
    EXPECT_EQ(json["kind"], "scene");
    EXPECT_EQ(json["name"], "Cube");
    EXPECT_EQ(json["size"], nlohmann::json({16, 12}));
    EXPECT_EQ(json["scene_size"], nlohmann::json({80, 60}));
    EXPECT_FALSE(json["front"].empty());
    EXPECT_EQ(xml_fault(text("out/time.svg")), "");
    EXPECT_TRUE(text("out/time.csv").starts_with("id,sweep,setting,"));
    const std::string page = text("out/report.html");
    EXPECT_THAT(page, HasSubstr("<h1>Cube</h1>"));
    EXPECT_EQ(page.find("src=\"http"), std::string::npos);
    EXPECT_TRUE(fs::exists(folder_ / "out/reference.exr"));
}

TEST_F(StudyCommand, OfASceneRefusesInOneLine) {
    write_cube(all_readings());
    write_scene();
    const auto study = [&](std::vector<std::string> more) {
        std::vector<std::string> arguments{"study", file("scene.toml"), "-o", file("out")};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run_culet(arguments);
    };
    expect_refused(study({"--draws", "3"}), "--draws is for studies of stones");
    expect_refused(study({"--only", "time"}), "--only is for studies of stones");
    expect_refused(study({"--size", "3"}), "--size");
    expect_refused(study({"--runs", "0"}), "--runs");
    expect_refused(study({"--set", "camera.look_at=[0,900,0]", "--budget", "5"}),
                   "does not see the stone");
    expect_refused(run_culet({"study", file("stone.toml"), "-o", file("out"), "--size", "64"}),
                   "--size is for studies of scenes");
    EXPECT_FALSE(fs::exists(folder_ / "out/study.json"));
}

TEST_F(StudyCommand, FitDrawsTheStone) {
    write_cube(all_readings());
    for (const char* paint : {"residual", "sigma"}) {
        const ProgramRun run = run_culet({"fit", file("stone.toml"), "-o", file("fitted.obj"),
                                          "--drawing", file("fitted.svg"), "--paint", paint, "-q"});
        EXPECT_LE(run.exit_code, 1) << run.err;
        const std::string svg = text("fitted.svg");
        EXPECT_EQ(xml_fault(svg), "");
        for (const char* part : {"<title>Cube</title>", ">Crown, from above<", ">Pavilion, ",
                                 ">Girdle, ", ">T</text>", ">B</text>", ">S</text>"}) {
            EXPECT_THAT(svg, HasSubstr(part));
        }
    }
    expect_refused(run_culet({"fit", file("stone.toml"), "-o", file("f.obj"), "--drawing",
                              file("nowhere/fitted.svg")}),
                   "nowhere");
    expect_refused(run_culet({"fit", file("stone.toml"), "-o", file("f.obj"), "--paint", "blue"}),
                   "--paint");
    EXPECT_FALSE(fs::exists(folder_ / "f.obj"));
}

}  // namespace
}  // namespace culet
