// Files of a project. Expectation: docs/studio.md, "The folder".

#include <gtest/gtest.h>

#include <unistd.h>

#include <cstdlib>
#include <filesystem>

#include "stone/cuts/cuts.h"
#include "stone/mesh/mesh_io.h"
#include "stone/text/errors.h"
#include "stone/text/path_fence.h"
#include "studio/answers.h"
#include "studio/edited_file.h"
#include "studio/new_project.h"
#include "studio/readings_table.h"
#include "tests/folder_test.h"

namespace culet {
namespace {

namespace fs = std::filesystem;

using ReadingsTableFiles = test::FolderTest;

TEST_F(ReadingsTableFiles, KeepWhatIsNotEdited) {
    const std::string given =
        "# first\nkind;of;value;sigma;note\ninclination;C1;33,8;0,1;\"a; \"\"b\"\"\"\n# between\n"
        "depth;;4;0,01;\"two\nlines\"\n";
    const std::string file = write("readings.csv", given);
    const ReadingsTable table(file, given);
    EXPECT_EQ(table.edited({}), given);
    EXPECT_EQ(table.edited({{0, "value", "34,0"}}),
              "# first\nkind;of;value;sigma;note\ninclination;C1;34,0;0,1;\"a; \"\"b\"\"\"\n"
              "# between\ndepth;;4;0,01;\"two\nlines\"\n");
    EXPECT_EQ(table.without_row(1),
              "# first\nkind;of;value;sigma;note\ninclination;C1;33,8;0,1;\"a; \"\"b\"\"\"\n"
              "# between\n");
    EXPECT_EQ(table.edited({{2, "kind", "weight"}, {2, "value", "1;0\n2"}}),
              given + "weight;;\"1;0 2\";;\n");
    EXPECT_THROW(table.edited({{9, "value", "1"}}), InputError);
    EXPECT_THROW(table.edited({{0, "colour", "1"}}), InputError);
    EXPECT_THROW(table.edited({{0, "note", std::string(10000, 'x')}}), InputError);
}

using EditedFiles = test::FolderTest;

TEST_F(EditedFiles, AreSavedAtOnceAndUndone) {
    EditedFile file(write("a.csv", "0\n"));
    for (const char* text : {"1\n", "2\n", "3\n"}) file.save(text);
    EXPECT_EQ(text("a.csv"), "3\n");
    file.undo();
    file.undo();
    EXPECT_EQ(text("a.csv"), "1\n");
    file.redo();
    EXPECT_EQ(text("a.csv"), "2\n");
    file.save("4\n");
    EXPECT_FALSE(file.can_redo());
    file.undo();
    EXPECT_EQ(text("a.csv"), "2\n");
}

TEST_F(EditedFiles, ForgetTheirOldestStates) {
    EditedFile file(write("a.csv", "0\n"));
    for (int i = 0; i < 3000; ++i) file.save(std::to_string(i + 1) + "\n");
    std::size_t steps = 0;
    for (; file.can_undo(); ++steps) file.undo();
    EXPECT_EQ(steps, k_history_steps - 1);
}

TEST_F(EditedFiles, NeverOverwriteAnothersChange) {
    EditedFile file(write("a.csv", "mine\n"));
    write("a.csv", "theirs\n");
    EXPECT_THROW(file.save("more\n"), InputError);
    EXPECT_THROW(file.undo(), InputError);
    EXPECT_EQ(text("a.csv"), "theirs\n");
    file.keep_own();
    EXPECT_EQ(text("a.csv"), "mine\n");
    file.undo();
    EXPECT_EQ(text("a.csv"), "theirs\n");
    // The same content under a new time is no change.
    file.save("same\n");
    fs::last_write_time(file.path(), fs::file_time_type::clock::now() + std::chrono::hours(1));
    EXPECT_FALSE(file.changed_outside());
    fs::remove(file.path());
    EXPECT_TRUE(file.changed_outside());
}

using Windows = test::FolderTest;

// Closing the window cancels what it asked for.
TEST_F(Windows, CancelTheirFitWhenTheyAreClosed) {
    fs::copy(fs::path(CULET_SOURCE_DIR) / "samples" / "cutters-evening", folder_ / "evening");
    setenv("XDG_STATE_HOME", (folder_ / "state").c_str(), 1);
    Answers answers(folder_ / "evening" / "stone.toml", "0");
    const auto window = answers.events().open("w");
    const std::string cell = R"({"opened": 1, "shape": 1, "cells": [{"row": 0, "column": "value", )"
                             R"("text": "33.5"}]})";
    ASSERT_EQ(answers.to({true, "/api/cells", cell, "w", {}}).status, 200);
    answers.events().close(window);
    answers.window_closed("w");
    const auto fit = [&] { return answers.to({false, "/api/fit", {}, {}, {}}).body; };
    while (fit().find(R"("runs":true)") != std::string::npos) usleep(1000);
    EXPECT_NE(fit().find(R"("status":"cancelled")"), std::string::npos) << fit();
    answers.window_opened("next");
    EXPECT_NE(fit().find(R"("runs":true)"), std::string::npos);
}

using NewProjects = test::FolderTest;

TEST_F(NewProjects, StandBesideTheirDesignAndOverwriteNothing) {
    write_design(make_cut("oval"), "oval", folder_ / "ring.obj");
    const fs::path first = stone_file_for(folder_ / "ring.obj");
    EXPECT_EQ(first, fs::canonical(folder_.path()) / "ring" / "stone.toml");
    write("ring/readings.csv", "kind,of,value,sigma\ndepth,,4,0.01\n");
    EXPECT_EQ(stone_file_for(folder_ / "ring.obj"), first) << "the same design again";
    EXPECT_EQ(text("ring/readings.csv"), "kind,of,value,sigma\ndepth,,4,0.01\n");
    write_design(make_cut("oval", {{"table", 60}}), "oval", folder_ / "ring.obj");
    EXPECT_EQ(stone_file_for(folder_ / "ring.obj").parent_path().filename(), "ring-2");
    // The mesh of a stone file beside it belongs to that.
    write("own.toml", "[stone]\nmesh = \"ring.obj\"\n");
    EXPECT_EQ(stone_file_for(folder_ / "ring.obj").filename(), "own.toml");
}

TEST_F(NewProjects, OpenAFolderByItsStoneFile) {
    EXPECT_EQ(stone_file_for(folder_.path()), "");
    write("one.toml", "[stone]\nmesh = \"x.obj\"\n");
    EXPECT_EQ(stone_file_for(folder_.path()).filename(), "one.toml");
    write("two.toml", "[stone]\nmesh = \"x.obj\"\n");
    EXPECT_EQ(stone_file_for(folder_.path()), "");
    EXPECT_THROW(stone_file_for(folder_ / "three.toml"), InputError);
    write("picture.png", "");
    EXPECT_THROW(stone_file_for(folder_ / "picture.png"), InputError);
}

TEST_F(NewProjects, PathsStayWithinTheirFolder) {
    fs::create_directory(folder_ / "in");
    fs::create_directory(folder_ / "in2");
    write("out.txt", "");
    fs::create_symlink(folder_ / "out.txt", folder_ / "in" / "link");
    const fs::path in = folder_ / "in";
    EXPECT_EQ(path_within(in, "new.txt"), fs::canonical(in) / "new.txt");
    for (const char* name : {"../out.txt", "link", "a/../../out.txt", "/etc/passwd", "../in2/x"})
        EXPECT_THROW(path_within(in, name), InputError) << name;
}

}  // namespace
}  // namespace culet
