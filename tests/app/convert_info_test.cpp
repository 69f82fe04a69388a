// culet convert and culet info as a user runs them: exit codes, streams, files.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/app/program_test.h"

namespace culet {
namespace {

using test::ProgramRun;
using test::run_culet;

const std::string k_design = CULET_SOURCE_DIR "/tests/stone/designs/srb_class_angles.asc";

class ConvertInfo : public test::ProgramTest {};

TEST_F(ConvertInfo, DesignGoesThroughEveryFormatAndBack) {
    std::string from = k_design;
    for (const char* extension : {"obj", "gcs", "off", "ply", "gem", "stl", "asc"}) {
        const std::string to = file(std::string("stone.").append(extension));
        const ProgramRun run = run_culet({"convert", from, to, "-q"});
        EXPECT_EQ(run.exit_code, 0) << run.err;
        EXPECT_TRUE(run.out.empty() && run.err.empty()) << run.out << run.err;
        const ProgramRun info = run_culet({"info", to, "--json", "-"});
        EXPECT_EQ(info.exit_code, 0) << info.err << info.out;
        const auto object = nlohmann::json::parse(info.out);
        EXPECT_EQ(object.at("schema"), 1);
        EXPECT_EQ(object.at("format"), extension);
        // Counts of a standard round brilliant of 16 girdle facets.
        EXPECT_EQ(object.at("facets"), 73);
        EXPECT_EQ(object.at("vertices"), 57);
        EXPECT_EQ(object.at("edges"), 128);
        EXPECT_EQ(object.at("euler"), 2);
        EXPECT_TRUE(object.at("closed"));
        EXPECT_TRUE(object.at("convex"));
        EXPECT_TRUE(object.at("faults").empty());
        EXPECT_EQ(object.at("facet_list").size(), 73u);
        from = to;
    }
}

// A cutter's words survive a mesh and back. The index is the material's (quartz, docs of materials:
// 1.544 ordinary, 1.553 extraordinary), or said to be unknown.
TEST_F(ConvertInfo, DesignKeepsItsWordsAndTheStonesIndex) {
    write(
        "words.asc",
        "GemCad 5.0\ng 96 0.0\ny 4 y\nH Words\na -90 1 96 n G 24 48 72 G Level girdle\n"
        "a -45 1.4142135623730951 96 n P 24 48 72 G TCP\na 0 0.5 96 n T G Leave frosted\nF Last\n");
    const ProgramRun mesh = run_culet({"convert", file("words.asc"), file("words.obj")});
    EXPECT_EQ(mesh.exit_code, 0) << mesh.err;
    const ProgramRun cut =
        run_culet({"convert", file("words.obj"), file("again.asc"), "--material", "quartz"});
    EXPECT_EQ(cut.exit_code, 0) << cut.err;
    const std::string again = text("again.asc");
    for (const char* kept : {"\ny 4 y\n", "\nH Words\n", " G Level girdle\n", " G TCP\n",
                             " G Leave frosted\n", "\nF Last\n"})
        EXPECT_NE(again.find(kept), std::string::npos) << kept << again;
    EXPECT_NEAR(std::stod(again.substr(again.find("\nI ") + 3)), 1.547, 0.004);
    const ProgramRun unknown = run_culet({"convert", file("words.obj"), file("third.asc")});
    EXPECT_NE(unknown.err.find("--material"), std::string::npos) << unknown.err;
}

// A float map with a scale of 2, which multiplies its values: every command that reads it prints a
// note.
TEST_F(ConvertInfo, NotesOfAPictureAreSaidOnce) {
    const float light[3]{0.25f, 0.5f, 1};
    const std::string map =
        write("map.pfm", "PF\n1 1\n-2\n" + std::string(reinterpret_cast<const char*>(light), 12));
    const ProgramRun info = run_culet({"info", map});
    EXPECT_EQ(info.exit_code, 0) << info.err;
    EXPECT_NE(info.out.find("linear PFM"), std::string::npos) << info.out;
    const ProgramRun photo = run_culet({"photo", map, "-o", file("map.exr")});
    EXPECT_EQ(photo.exit_code, 0) << photo.err;
    for (const std::string& said : {info.out, photo.err}) {
        const std::size_t note = said.find("multiplied by its scale, 2");
        EXPECT_NE(note, std::string::npos) << said;
        EXPECT_EQ(said.find("multiplied by its scale", note + 1), std::string::npos) << said;
    }
    EXPECT_EQ(run_culet({"info", file("map.exr")}).out.find("note:"), std::string::npos);
}

TEST_F(ConvertInfo, MessagesGoToStderrAndResultsToStdout) {
    const ProgramRun run = run_culet({"convert", k_design, file("a.obj")});
    EXPECT_EQ(run.exit_code, 0);
    EXPECT_TRUE(run.out.empty());
    EXPECT_EQ(run.err, "next: culet render " + file("a.obj") +
                           " --material NAME -o stone.png (a picture)\n");
    // Reported on request where planes miss a meet by more than rounding error; this design's do
    // not.
    const std::string missing = CULET_SOURCE_DIR "/samples/dravite-step/making/truth.asc";
    for (const std::string& design : {k_design, missing}) {
        const ProgramRun more = run_culet({"convert", design, file("b.obj"), "-v"});
        EXPECT_TRUE(more.out.empty());
        EXPECT_EQ(more.err.find("joined meets that miss") != std::string::npos, design == missing);
    }
    const ProgramRun info = run_culet({"info", k_design, "--json", file("a.json")});
    EXPECT_EQ(info.exit_code, 0);
    EXPECT_TRUE(info.err.empty()) << info.err;
    EXPECT_NE(info.out.find("73 facets"), std::string::npos);
    EXPECT_EQ(json("a.json").at("gear"), 96);
    const ProgramRun table = run_culet({"info", k_design, "-v"});
    EXPECT_NE(table.out.find("inclination"), std::string::npos);
}

TEST_F(ConvertInfo, BrokenMeshIsConvertedWithAWarning) {
    write("open.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\n");
    const ProgramRun run = run_culet({"convert", file("open.obj"), file("open.ply")});
    EXPECT_EQ(run.exit_code, 1);
    EXPECT_NE(run.err.find("warning"), std::string::npos);
    EXPECT_TRUE(std::filesystem::exists(file("open.ply")));
    const ProgramRun info = run_culet({"info", file("open.ply"), "--json", "-"});
    EXPECT_EQ(info.exit_code, 1);
    const auto object = nlohmann::json::parse(info.out);
    EXPECT_EQ(object.at("faults").size(), 3u);
    EXPECT_EQ(object.at("faults")[0].at("kind"), "open");
    // A cut design cannot hold this mesh.
    refusal({"convert", file("open.obj"), file("open.asc")});
    EXPECT_FALSE(std::filesystem::exists(file("open.asc")));
}

// Another program's file of the same stone is no difference; an angle is, and another name.
TEST_F(ConvertInfo, DiffSaysWhatIsSetOtherwise) {
    EXPECT_EQ(run_culet({"convert", k_design, file("same.gcs"), "-q"}).exit_code, 0);
    const ProgramRun same = run_culet({"info", k_design, "--diff", file("same.gcs")});
    EXPECT_EQ(same.exit_code, 0) << same.out << same.err;
    EXPECT_NE(same.out.find("are cut alike"), std::string::npos) << same.out;
    const std::string head = "GemCad 5.0\ng 96 0.0\ny 4 y\nI 1.54\n";
    const std::string rest = "a -90 1 96 n G 24 48 72\na 0 0.5 96 n T\n";
    write("a.asc", head + "a -45 1.2 96 n P 24 48 72\n" + rest);
    write("b.asc", head + "a -46 1.2 96 n P 24 48 72\n" + rest);
    const ProgramRun run = run_culet({"info", file("a.asc"), "--diff", file("b.asc")});
    EXPECT_EQ(run.exit_code, 1);
    EXPECT_EQ(run.out, "P: angle: 45, then 46\n");
    const ProgramRun told =
        run_culet({"info", file("a.asc"), "--diff", file("b.asc"), "--json", "-"});
    EXPECT_EQ(told.exit_code, 1);
    const auto object = nlohmann::json::parse(told.out);
    EXPECT_EQ(object.at("against"), file("b.asc"));
    ASSERT_EQ(object.at("differences").size(), 1u);
    EXPECT_EQ(object["differences"][0],
              (nlohmann::json{{"what", "angle"}, {"tier", "P"}, {"a", "45"}, {"b", "46"}}));
    refusal({"info", file("a.asc"), "--diff", file("b.asc"), "--width", "6mm"});
    refusal({"info", file("a.asc"), "--diff", file("none.asc")});
}

// GIA rounds crown angles to half degrees, AGS to tenths (docs/fit-report.md). A report's
// proportions come with sigmas.
TEST_F(ConvertInfo, ProportionsAreRoundedInTheLaboratoriesStyle) {
    const auto json = nlohmann::json::parse(run_culet({"info", k_design, "--json", "-"}).out);
    const auto named = [&](const char* name) {
        for (const auto& one : json.at("proportions")) {
            if (one.at("name") == name) return one;
        }
        return nlohmann::json();
    };
    const double crown = named("crown angle").at("value");
    EXPECT_NEAR(named("crown angle").at("gia").get<double>(), crown, 0.25 + 1e-9);
    EXPECT_NEAR(named("crown angle").at("ags").get<double>(), crown, 0.05 + 1e-9);
    EXPECT_FALSE(named("crown angle min").contains("gia"));
    const ProgramRun gia = run_culet({"info", k_design, "--style", "gia"});
    EXPECT_EQ(gia.exit_code, 0) << gia.err;
    EXPECT_THAT(gia.out, ::testing::ContainsRegex("crown angle +[0-9.]+ deg +[0-9]+(\\.5)?\n"));
    write("fit.json",
          R"({"proportions": [{"name": "table", "value": 56.61, "sigma": 0.12, "unit": "%",
                   "gia": 57, "ags": 56.6}]})");
    const ProgramRun sure =
        run_culet({"info", k_design, "--style", "ags", "--report", file("fit.json")});
    EXPECT_EQ(sure.exit_code, 0) << sure.err;
    EXPECT_THAT(sure.out, ::testing::ContainsRegex("table +56.61 \\+- 0.12 % +56.6\n"));
    EXPECT_EQ(run_culet({"info", k_design, "--report", file("fit.json")}).exit_code, 2);
    EXPECT_EQ(run_culet({"info", k_design, "--style", "igi"}).exit_code, 2);
}

TEST_F(ConvertInfo, WhatCannotBeDoneIsOneLine) {
    refusal({"convert", k_design, file("a.3ds")});
    refusal({"convert", k_design, file("a.gcs"), "--width", "6mm"});
    refusal({"convert", file("missing.obj"), file("a.obj")});
    refusal({"convert", k_design, file("no/such/folder.obj")});
    refusal({"convert", k_design});
    refusal({"convert", k_design, file("a.obj"), "--meet-tolerance", "7"});
    refusal({"info", file("missing.asc")});
    refusal({"info", folder_.path().string()});
    refusal({"info", k_design, "--json", folder_.path().string()});
    write("a.xyz", "1 2 3\n");
    refusal({"info", file("a.xyz")});
    write("bad\n\033[31m.obj", "v 0 0\n");
    refusal({"info", file("bad\n\033[31m.obj")});
    EXPECT_FALSE(std::filesystem::exists(file("a.obj")));
}

TEST_F(ConvertInfo, ToleranceOfMeets) {
    const ProgramRun run = run_culet({"info", k_design, "--meet-tolerance", "0", "--json", "-"});
    // Joined it has 57; if each raw vertex joined only three facets it would have 2 F - 4 = 142.
    const int vertices = nlohmann::json::parse(run.out).at("vertices");
    EXPECT_GT(vertices, 57);
    EXPECT_LE(vertices, 142);
}

TEST_F(ConvertInfo, StoneAndMaterialFiles) {
    EXPECT_EQ(run_culet({"convert", k_design, file("stone.obj"), "-q"}).exit_code, 0);
    write("stone.toml",
          "[stone]\nname = \"Test\"\nmesh = \"stone.obj\"\nmaterial = \"diamond\"\nunit = \"cm\"\n"
          "up = [0, 0, 1]\n");
    const ProgramRun stone = run_culet({"info", file("stone.toml"), "--json", "-"});
    ASSERT_EQ(stone.exit_code, 0) << stone.err;
    const auto object = nlohmann::json::parse(stone.out);
    EXPECT_EQ(object.at("format"), "stone");
    // 1 cm3 is 1000 mm3; diamond has 3.51 to 3.53 g/cm3, and 5 ct are a gram.
    const double mm3 = object.at("volume_mm3");
    EXPECT_NEAR(mm3, 1000 * object.at("volume").get<double>(), 1e-9 * mm3);
    EXPECT_NEAR(object.at("carat").get<double>(), mm3 * 3.52 / 200, 0.01 * mm3 / 200);
    write("glass.toml", "[material]\noptic = \"isotropic\"\nindex = 1.5\ndensity = 2.5\n");
    const ProgramRun glass = run_culet({"info", file("glass.toml"), "--json", "-"});
    ASSERT_EQ(glass.exit_code, 0) << glass.err;
    EXPECT_EQ(nlohmann::json::parse(glass.out).at("material").at("optic"), "isotropic");
}

TEST_F(ConvertInfo, SceneOfObjectsAlone) {
    write("scene.toml",
          "[camera]\nposition = [0, -9, 5]\nlook_at = [0, 0, 0]\n[light]\nconstant = 1\n"
          "[[object]]\nshape = \"sphere\"\nradius = 1\nmaterial = { kind = \"mirror\" }\n"
          "[[object]]\nshape = \"plane\"\nmaterial = { kind = \"diffuse\" }\n");
    const ProgramRun info = run_culet({"info", file("scene.toml"), "--json", "-"});
    EXPECT_EQ(info.exit_code, 0) << info.err << info.out;
    const auto object = nlohmann::json::parse(info.out);
    EXPECT_EQ(object.at("format"), "scene");
    ASSERT_EQ(object.at("objects").size(), 2u);
    EXPECT_EQ(object.at("objects")[0].at("shape"), "sphere");
    EXPECT_EQ(object.at("objects")[0].at("material"), "mirror");
}

TEST_F(ConvertInfo, SceneGoesToPovray) {
    EXPECT_EQ(run_culet({"convert", k_design, file("stone.obj"), "-q"}).exit_code, 0);
    write("scene.toml",
          "mesh = \"stone.obj\"\nmaterial = \"diamond\"\n[light]\nconstant = 1\n[render]\n"
          "depth = 5\n");
    const ProgramRun run = run_culet({"convert", file("scene.toml"), file("scene.pov")});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_TRUE(run.out.empty());
    EXPECT_NE(run.err.find("not carried: dispersion"), std::string::npos) << run.err;
    EXPECT_NE(text(file("scene.pov")).find("max_trace_level 6 "), std::string::npos);
    const ProgramRun set = run_culet(
        {"convert", file("scene.toml"), file("scene.pov"), "-q", "--set", "render.depth=8"});
    EXPECT_TRUE(set.err.empty()) << set.err;
    EXPECT_NE(text(file("scene.pov")).find("max_trace_level 9 "), std::string::npos);
    refusal({"convert", file("stone.obj"), file("a.pov")});
    refusal({"convert", file("scene.toml"), file("a.obj")});
    refusal({"convert", k_design, file("a.obj"), "--set", "render.depth=8"});
    refusal({"convert", file("scene.toml"), file("a.pov"), "--set", "camera.analyzer=0"});
    EXPECT_FALSE(std::filesystem::exists(file("a.pov")));
}

// Two exports of one scene into one folder: each finds its files, and the scene's mesh is
// unchanged.
TEST_F(ConvertInfo, SceneGoesToMitsubaAndPbrtInOneFolder) {
    EXPECT_EQ(run_culet({"convert", k_design, file("scene-1.obj"), "-q"}).exit_code, 0);
    const std::string mesh = text(file("scene-1.obj"));
    write("scene.toml",
          "mesh = \"scene-1.obj\"\nmaterial = \"diamond\"\n[light]\npreset = \"jeweller\"\n");
    std::string map_of_mitsuba;
    for (const char* name : {"scene.xml", "scene.pbrt"}) {
        const ProgramRun run = run_culet({"convert", file("scene.toml"), file(name)});
        EXPECT_EQ(run.exit_code, 0) << run.err;
        EXPECT_NE(run.err.find("not carried: "), std::string::npos) << run.err;
        if (map_of_mitsuba.empty()) map_of_mitsuba = text(file("scene-mitsuba-light.exr"));
    }
    EXPECT_FALSE(map_of_mitsuba.empty());
    EXPECT_EQ(text(file("scene-mitsuba-light.exr")), map_of_mitsuba);
    EXPECT_FALSE(text(file("scene-pbrt-light.exr")).empty());
    EXPECT_FALSE(text(file("scene-mitsuba-1.obj")).empty());
    EXPECT_EQ(text(file("scene-1.obj")), mesh);
}

// A file over the size limit (SIGXFSZ) is a failed write: one line, exit code 2, and no file left,
// not even a temporary one.
TEST_F(ConvertInfo, AFileThatMayNotGrowIsRefusedInALine) {
    rlimit before{};
    ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
    rlimit little = before;
    little.rlim_cur = 1024;
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &little), 0);
    const ProgramRun run = run_culet({"convert", k_design, file("large.obj"), "-q"});
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0);
    refusal_of(run);
    EXPECT_NE(run.err.find("cannot be written"), std::string::npos) << run.err;
    EXPECT_TRUE(std::filesystem::is_empty(folder_.path()));
}

TEST_F(ConvertInfo, HelpHasExamples) {
    for (const char* command : {"convert", "info"}) {
        const ProgramRun run = run_culet({command, "--help"});
        EXPECT_EQ(run.exit_code, 0);
        EXPECT_NE(run.out.find("Examples:"), std::string::npos);
    }
}

}  // namespace
}  // namespace culet
