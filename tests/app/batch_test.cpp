// culet batch as a laboratory runs it: many stones, some of them bad, on machines that fail.

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <random>
#include <thread>

#include "tests/app/program_test.h"

extern char** environ;

namespace culet {
namespace {

namespace fs = std::filesystem;
using test::ProgramRun;
using test::run_culet;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using Json = nlohmann::json;

std::map<std::string, std::string> tree_of(const fs::path& folder) {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        std::ifstream stream(entry.path(), std::ios::binary);
        std::string bytes;
        if (entry.is_regular_file()) bytes.assign(std::istreambuf_iterator<char>(stream), {});
        files[fs::relative(entry.path(), folder).string()] = std::move(bytes);
    }
    return files;
}

std::vector<std::string> differences(const std::map<std::string, std::string>& a,
                                     const std::map<std::string, std::string>& b) {
    std::vector<std::string> names;
    for (const auto& [name, bytes] : a) {
        const auto other = b.find(name);
        if (other == b.end() || other->second != bytes) names.push_back(name);
    }
    for (const auto& [name, bytes] : b)
        if (!a.contains(name)) names.push_back(name);
    return names;
}

class BatchCommand : public test::ProgramTest {
protected:
    void SetUp() override {
        fs::create_directory(folder_ / "stones");
        cut("emerald", "stones/mesh.obj");
    }
    // A stone with one reading and without a material: quick to fit, not graded.
    void write_stone(const std::string& name, double depth) const {
        write("stones/" + name,
              "[stone]\nmesh = \"mesh.obj\"\nunit = \"mm\"\n"
              "[[reading]]\nkind = \"depth\"\nvalue = " +
                  std::to_string(depth) + "\nsigma = 0.01\n");
    }
    void write_stones(int count) const {
        for (int i = 0; i < count; ++i)
            write_stone("s" + std::to_string(100 + i) + ".toml", 3.6 + 0.001 * i);
    }
    ProgramRun batch(std::vector<std::string> more) const {
        more.insert(more.begin(), {"batch"});
        return run_culet(more);
    }
};

TEST_F(BatchCommand, ShortensNamesThatNoFolderCouldHave) {
    const std::string stem(160, 'w');
    write_stone(stem + "1.toml", 3.6);
    write_stone(stem + "2.toml", 3.6);
    const ProgramRun run = batch({file("stones"), "-o", file("out")});
    EXPECT_NE(run.exit_code, 2) << run.err;
    const Json table = json("out/table.json");
    ASSERT_EQ(table.at("jobs").size(), 2u);
    for (const Json& job : table["jobs"]) EXPECT_LE(job.at("name").get<std::string>().size(), 100u);
    EXPECT_NE(table["jobs"][0]["name"], table["jobs"][1]["name"]);
}

TEST_F(BatchCommand, FitsAndGradesWhatAFolderHolds) {
    write_stone("a.toml", 3.6);
    cut("emerald", "stones/b.asc");
    write("stones/scene.toml", "stone = \"a.toml\"\n[light]\nconstant = 1.0\n");
    write("stones/bad.toml", "[stone\n");
    const ProgramRun run = batch(
        {file("stones"), "-o", file("out"), "--index", "1.6", "--tilts", "0", "--pages", "-v"});
    EXPECT_EQ(run.exit_code, 1);
    EXPECT_THAT(run.err, HasSubstr("bad: bad.toml:1:"));
    EXPECT_THAT(run.err, HasSubstr("left out: mesh.obj"));
    EXPECT_THAT(run.err, HasSubstr("left out: scene.toml"));
    EXPECT_THAT(run.out, HasSubstr("index.html"));
    EXPECT_THAT(run.err, HasSubstr("\nnext: open " + file("out/index.html")));
    const Json table = json("out/table.json");
    ASSERT_EQ(table.at("jobs").size(), 3u);
    EXPECT_EQ(table["jobs"][0]["name"], "a");
    EXPECT_GT(table["jobs"][0]["grade"]["iso"].get<double>(), 0);
    EXPECT_EQ(table["jobs"][1]["status"], "graded");
    EXPECT_EQ(table["jobs"][2]["status"], "failed");
    EXPECT_EQ(table["jobs"][2]["exit_code"], 2);
    EXPECT_EQ(table["counts"]["failed"], 1);
    for (const char* name : {"fitted.obj", "fit.json", "fit.html", "grade.json", "grade.html",
                             "stone.png", "job.json"})
        EXPECT_TRUE(fs::exists(folder_ / ("out/jobs/a/" + std::string(name)))) << name;
    EXPECT_FALSE(fs::exists(folder_ / "out/unfinished"));
    const ProgramRun alone = run_culet(
        {"grade", file("stones/b.asc"), "--index", "1.6", "--tilts", "0", "--json", "-", "-q"});
    EXPECT_EQ(Json::parse(alone.out)["models"], json("out/jobs/b/grade.json")["models"]);
    // The page embeds the picture, and lists the failed stone first.
    const std::string page = tree_of(folder_ / "out")["index.html"];
    EXPECT_THAT(page, HasSubstr("data:image/png;base64,"));
    EXPECT_LT(page.find("bad.toml"), page.find("a, face up"));
}

TEST_F(BatchCommand, SharesMakeTheBytesOfOneRun) {
    write_stones(7);
    ASSERT_EQ(batch({file("stones"), "-o", file("one"), "-q", "--threads", "2"}).exit_code,
              batch({file("stones"), "-o", file("again"), "-q", "--threads", "1"}).exit_code);
    for (int k = 2; k >= 0; --k)
        batch({file("stones"), "-o", file("shares"), "--shard", std::to_string(k) + "/3", "-q"});
    EXPECT_FALSE(fs::exists(folder_ / "shares/table.csv"));
    batch({"--merge", file("shares"), "-q"});
    const auto one = tree_of(folder_ / "one");
    EXPECT_EQ(one.size(), 5u + 7u * 4u);  // plan, two tables, page and log of jobs; each job has
                                          // three files
    EXPECT_EQ(one, tree_of(folder_ / "again"));
    EXPECT_EQ(one, tree_of(folder_ / "shares"));
}

TEST_F(BatchCommand, ResumeDoesWhatHasChanged) {
    write_stones(3);
    ASSERT_NE(batch({file("stones"), "-o", file("out"), "-q"}).exit_code, 2);
    const auto before = tree_of(folder_ / "out");
    const ProgramRun refused = batch({file("stones"), "-o", file("out")});
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_THAT(refused.err, HasSubstr("--resume"));
    EXPECT_EQ(before, tree_of(folder_ / "out"));
    EXPECT_THAT(batch({file("stones"), "-o", file("out"), "--resume"}).err,
                HasSubstr("0 jobs done"));
    EXPECT_EQ(before, tree_of(folder_ / "out"));
    write_stone("s101.toml", 3.7);
    EXPECT_THAT(batch({file("stones"), "-o", file("out"), "--resume"}).err,
                HasSubstr("1 jobs done"));
    EXPECT_NE(before.at("jobs/s101/fit.json"), tree_of(folder_ / "out").at("jobs/s101/fit.json"));
    // Every stone uses the mesh file.
    std::ofstream(folder_ / "stones/mesh.obj", std::ios::app) << "# looked at\n";
    EXPECT_THAT(batch({file("stones"), "-o", file("out"), "--resume"}).err,
                HasSubstr("3 jobs done"));
    EXPECT_THAT(batch({file("stones"), "-o", file("out"), "--resume", "--seed", "2"}).err,
                HasSubstr("3 jobs done"));
}

// Kills the process and its workers while they work; finished results must stay.
TEST_F(BatchCommand, KilledTwentyTimesItLosesNothing) {
    constexpr int k_stones = 12;
    write_stones(k_stones);
    const auto start = std::chrono::steady_clock::now();
    ASSERT_NE(batch({file("stones"), "-o", file("whole"), "-q"}).exit_code, 2);
    const auto whole_run = std::chrono::duration_cast<std::chrono::microseconds>(
        std::chrono::steady_clock::now() - start);
    const auto whole = tree_of(folder_ / "whole");
    std::mt19937 random(7);
    // A share of the time of an undisturbed run, so that the kill comes during work on any machine.
    std::uniform_real_distribution<double> share(0.02, 0.25);
    const std::string stones = file("stones"), out = file("out");
    int interrupted_at_work = 0;
    for (int i = 0; i < 20; ++i) {
        std::vector<const char*> words{CULET_PROGRAM, "batch",    stones.c_str(), "-o",
                                       out.c_str(),   "--resume", "-q",           nullptr};
        pid_t child = 0;
        ASSERT_EQ(::posix_spawn(&child, words[0], nullptr, nullptr,
                                const_cast<char* const*>(words.data()), environ),
                  0);
        std::this_thread::sleep_for(share(random) * whole_run);
        ::kill(child, SIGKILL);
        int status = 0;
        ASSERT_EQ(::waitpid(child, &status, 0), child);
        interrupted_at_work += WIFSIGNALED(status) ? 1 : 0;
        // Nothing is left to disturb: start again.
        if (!WIFSIGNALED(status)) {
            ASSERT_THAT(differences(whole, tree_of(folder_ / "out")), IsEmpty())
                << "after kill " << i;
            fs::remove_all(folder_ / "out");
        }
        if (!fs::exists(folder_ / "out/jobs")) continue;
        // Any file under its final name is complete: the bytes of an undisturbed run.
        for (const auto& [name, bytes] : tree_of(folder_ / "out/jobs"))
            ASSERT_EQ(bytes, whole.at("jobs/" + name)) << name << " after kill " << i;
        for (const auto& entry : fs::directory_iterator(folder_ / "out/jobs"))
            ASSERT_TRUE(fs::exists(entry.path() / "job.json")) << entry.path();
    }
    EXPECT_GE(interrupted_at_work, 5);
    const ProgramRun last = batch({file("stones"), "-o", file("out"), "--resume", "-q"});
    ASSERT_NE(last.exit_code, 2) << last.err;
    EXPECT_THAT(differences(whole, tree_of(folder_ / "out")), IsEmpty());
}

TEST_F(BatchCommand, ATableOfJobs) {
    write_stone("a.toml", 3.6);
    write("jobs.csv",
          "Name;Stone;fit.iterations\nfirst;stones/a.toml;\nsecond;stones/a.toml;50\n"
          "gone;stones/none.toml;\n" +
              std::string(150, 'x') + ";stones/none.toml;\n");
    EXPECT_EQ(batch({file("jobs.csv"), "-o", file("out"), "-q"}).exit_code, 1);
    const Json table = json("out/table.json");
    ASSERT_EQ(table["jobs"].size(), 4u);
    // A folder's name has at most 100 bytes (docs/batch.md).
    EXPECT_EQ(table["jobs"][3]["name"].get<std::string>().size(), 100u);
    EXPECT_EQ(json("out/jobs/second/fit.json")["options"]["iterations"], 50);
    EXPECT_EQ(table["jobs"][2]["status"], "failed");
    EXPECT_THAT(table["jobs"][2]["message"].get<std::string>(), HasSubstr("stones/none.toml"));
}

TEST_F(BatchCommand, RefusesInOneLine) {
    write_stone("a.toml", 3.6);
    const auto refused = [&](const std::string& csv, const char* why) {
        write("jobs.csv", csv);
        EXPECT_THAT(refusal_of(batch({file("jobs.csv"), "-o", file("out")})), HasSubstr(why));
        EXPECT_FALSE(fs::exists(folder_ / "out"));
    };
    const std::string stone = "stones/a.toml";
    refused("stone,name\n" + stone + ",../up\n", "jobs.csv:2");
    refused("stone,name\n" + stone + ",\"two\nlines\"\n", "cannot be the name");
    refused("stone,name\n" + stone + ",.hidden\n", "cannot be the name");
    refused("stone,name\n" + stone + ",a\n" + stone + ",a\n", "line 2 already");
    refused("stone,name\n,a\n", "no stone in this row");
    refused("stone,wood\n" + stone + ",a\n", "unknown column");
    refused("name\na\n", "column stone");
    refused("stone\n", "no jobs");
    refused("", "is empty");
    fs::create_directory(folder_ / "empty");
    EXPECT_THAT(batch({file("empty"), "-o", file("out")}).err, HasSubstr("has no stone in it"));
    EXPECT_THAT(batch({file("none"), "-o", file("out")}).err, HasSubstr("no such folder"));
    EXPECT_THAT(batch({file("stones"), "-o", file("stones")}).err, HasSubstr("jobs themselves"));
    EXPECT_THAT(batch({file("stones"), "-o", folder_.path().string()}).err,
                HasSubstr("jobs themselves"));
    EXPECT_THAT(batch({file("stones"), "-o", file("stones/a.toml")}).err, HasSubstr("is a file"));
    EXPECT_THAT(batch({file("stones"), "-o", file("out"), "--shard", "5/5"}).err,
                HasSubstr("0 to N - 1"));
    EXPECT_THAT(batch({"--merge", file("stones")}).err, HasSubstr("holds no batch"));
    EXPECT_FALSE(fs::exists(folder_ / "out"));
}

// A file name must not escape the results folder or inject markup into the page.
TEST_F(BatchCommand, HostileNamesAreMadeHarmless) {
    fs::remove(folder_ / "stones/mesh.obj");
    write("stones/<script>\n.toml", "[stone\n");
    write("stones/-rf.toml", "[stone\n");
    EXPECT_EQ(batch({file("stones"), "-o", file("out"), "-q"}).exit_code, 1);
    const auto tree = tree_of(folder_ / "out");
    EXPECT_EQ(tree.count("jobs/_script__/job.json"), 1u);
    EXPECT_EQ(tree.count("jobs/_rf/job.json"), 1u);
    EXPECT_EQ(tree.at("index.html").find("<script>\n."), std::string::npos);
}

}  // namespace
}  // namespace culet
