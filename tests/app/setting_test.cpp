// culet setting as a jeweller runs it.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "render/scene/scene_io.h"
#include "stone/mesh/surface_mesh.h"
#include "tests/app/program_test.h"

namespace culet {
namespace {

namespace fs = std::filesystem;
using test::ProgramRun;
using test::run_culet;
using ::testing::HasSubstr;

class SettingCommand : public test::ProgramTest {
protected:
    void SetUp() override { cut("oval", "oval.obj"); }
};

TEST_F(SettingCommand, WritesMeshSceneAndNumbers) {
    const ProgramRun run =
        run_culet({"setting", file("oval.obj"), "--material", "peridot", "--prongs", "4", "--metal",
                   "rose-gold", "-o", file("ring.obj"), "--scene", file("ring.toml"), "--json",
                   file("ring.json")});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    EXPECT_EQ(run.out, "");
    EXPECT_THAT(run.err, HasSubstr("\nnext: culet render " + file("ring.toml")));
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 2) << run.err;
    const auto json = this->json("ring.json");
    EXPECT_EQ(json.at("prongs"), 4);
    EXPECT_EQ(json.at("ring_diameter"), 17);
    EXPECT_GE(json.at("least_gap"), json.at("clearance"));
    const TriangleMesh mesh = read_triangle_mesh(file("ring.obj"));
    EXPECT_EQ(mesh.triangles.size(), json.at("triangles").get<std::size_t>());
    // Reads the scene back: the stone and the metal on a ground, all in front of the camera.
    const Scene scene = read_scene(file("ring.toml"));
    EXPECT_EQ(scene.stone.material.id, "peridot");
    ASSERT_EQ(scene.objects.size(), 2u);
    const auto* metal = std::get_if<MeshShape>(&scene.objects[0].shape);
    ASSERT_NE(metal, nullptr);
    const auto* ground = std::get_if<PlaneShape>(&scene.objects[1].shape);
    ASSERT_NE(ground, nullptr);
    double lowest = 1e9;
    for (const Vec3& v : metal->mesh->vertices) lowest = std::min(lowest, v.z);
    EXPECT_NEAR(ground->point.z, lowest, 1e-4);
    const auto& f0 = *std::get<MetalMaterial>(scene.objects[0].material).f0;
    EXPECT_NEAR(std::get<Rgb>(f0.value)[1], 0.730, 1e-12);
}

TEST_F(SettingCommand, IsTheSameEveryTimeAndInEveryFormat) {
    std::size_t triangles = 0;
    for (const char* name : {"a.obj", "b.obj", "c.ply", "d.stl", "e.off"}) {
        ASSERT_EQ(
            run_culet({"setting", file("oval.obj"), "--smoothness", "8", "-q", "-o", file(name)})
                .exit_code,
            0);
        const std::size_t read = read_triangle_mesh(file(name)).triangles.size();
        if (triangles == 0) triangles = read;
        EXPECT_EQ(read, triangles) << name;
    }
    EXPECT_EQ(text("a.obj"), text("b.obj"));
}

TEST_F(SettingCommand, CountsInTheUnitOfTheStone) {
    write("stone.toml", "[stone]\nmesh = \"oval.obj\"\nmaterial = \"peridot\"\nunit = \"cm\"\n");
    const ProgramRun run =
        run_culet({"setting", file("stone.toml"), "--prong-diameter", "8mm", "--ring", "60mm", "-q",
                   "-o", file("ring.ply"), "--json", "-"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const auto json = nlohmann::json::parse(run.out);
    EXPECT_NEAR(json.at("prong_diameter"), 0.8, 1e-12);
    EXPECT_NEAR(json.at("ring_diameter"), 6, 1e-12);
}

TEST_F(SettingCommand, WhatCannotBeDoneIsOneLineAndLeavesNothing) {
    write("open.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    const std::vector<std::vector<std::string>> cases{
        {"-o", "a.gif"},
        {"-o", "no/folder.obj"},
        {"-o", "a.obj", "--prongs", "1"},
        {"-o", "a.obj", "--prongs", "25"},
        {"-o", "a.obj", "--prongs", "4", "--style", "bezel"},
        {"-o", "a.obj", "--metal", "tin"},
        {"-o", "a.obj", "--ring", "-3"},
        {"-o", "a.obj", "--ring", "wide"},
        {"-o", "a.obj", "--clearance", "9"},
        {"-o", "a.obj", "--prong-diameter", "0"},
        {"-o", "a.obj", "--smoothness", "10"},
        {"-o", "a.obj", "--scene", "a.toml"},  // a mesh has no material
        {"-o", "a.obj", "--scene", "no/folder.toml", "--material", "peridot"},
        {"-o", "a.obj", "--scene", "a.toml", "--material", "kryptonite"},
    };
    for (std::vector<std::string> words : cases) {
        for (std::string& word : words) {
            if (word.starts_with("a.") || word.starts_with("no/")) word = file(word);
        }
        words.insert(words.begin(), {"setting", file("oval.obj")});
        refusal(words);
    }
    const ProgramRun open = run_culet({"setting", file("open.obj"), "-o", file("a.obj")});
    EXPECT_EQ(open.exit_code, 2);
    EXPECT_THAT(open.err, HasSubstr("open.obj: cannot be set"));
    for (const char* name : {"a.gif", "a.obj", "a.toml"}) EXPECT_FALSE(fs::exists(file(name)));
}

TEST_F(SettingCommand, SceneOfAStoneFileNamesIt) {
    write("stone.toml", "[stone]\nmesh = \"oval.obj\"\nmaterial = \"sapphire_blue\"\n");
    fs::create_directory(folder_ / "made");
    ASSERT_EQ(run_culet({"setting", file("stone.toml"), "-q", "--style", "bezel", "-o",
                         file("made/bezel.obj"), "--scene", file("scene.toml")})
                  .exit_code,
              0);
    EXPECT_THAT(text("scene.toml"), HasSubstr("stone = \"stone.toml\""));
    EXPECT_THAT(text("scene.toml"), HasSubstr("file = \"made/bezel.obj\""));
    EXPECT_EQ(read_scene(file("scene.toml")).stone.material.id, "sapphire_blue");
    ASSERT_EQ(run_culet({"setting", file("stone.toml"), "-q", "--material", "garnet_almandine",
                         "-o", file("ring.obj"), "--scene", file("red.toml")})
                  .exit_code,
              0);
    EXPECT_EQ(read_scene(file("red.toml")).stone.material.id, "garnet_almandine");
}

}  // namespace
}  // namespace culet
