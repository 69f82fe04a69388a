// Runs the commands of the documents' code blocks, page by page in order, in a folder with the
// files they name, with small pictures and searches. Expectation: every command ends with 0, or
// with 1 where the answer is doubtful.

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "tests/app/written_lines.h"
#include "tests/folder_test.h"

namespace culet {
namespace {

namespace fs = std::filesystem;
const fs::path k_source = CULET_SOURCE_DIR;

// Options that make a command small; options that the command already has are not added.
struct Small {
    const char* command;
    std::vector<std::pair<std::string, std::string>> options;
};
const std::vector<Small> k_small = {
    {"render", {{"--size", "48"}}},
    {"grade", {{"--tilts", "0"}, {"--draws", "2"}, {"--size", "32"}}},
    {"batch", {{"--tilts", "0"}, {"--draws", "0"}}},
    {"optimize", {{"--evaluations", "40"}}},
    {"study", {{"--budget", "2"}, {"--draws", "2"}}},
};

// Other tests run these: on files that take minutes to make, or until they are ended.
const std::vector<std::string> k_elsewhere = {"culet refine", "culet outline", "culet compare",
                                              "culet spin", "culet studio"};

// The commands of a page's code blocks, fenced or indented: lines that begin with culet, with their
// continuations. A line with a word in brackets is a summary of options.
std::vector<std::string> commands_of(const fs::path& page) {
    std::vector<std::string> found;
    const std::regex begins(R"re(^(?:    )?(?:build/)?(culet [a-z].*)$)re");
    bool fenced = false;
    for (const auto& [number, line] : test::written_lines(page)) {
        if (line.rfind("```", 0) == 0) fenced = !fenced;
        std::smatch parts;
        const bool in_code = fenced || line.rfind("    ", 0) == 0;
        if (in_code && std::regex_match(line, parts, begins)) found.push_back(parts[1].str());
    }
    std::erase_if(found, [](const std::string& command) {
        return command.find('[') != std::string::npos ||
               std::any_of(k_elsewhere.begin(), k_elsewhere.end(),
                           [&](const std::string& e) { return command.rfind(e, 0) == 0; });
    });
    return found;
}

std::string made_small(const std::string& command) {
    std::string text = command.substr(0, command.find('#'));
    // A test opens nothing and draws few stones.
    text = std::regex_replace(text, std::regex(" --open"), "");
    text = std::regex_replace(text, std::regex(" --draws [0-9]+"), " --draws 2");
    for (const Small& small : k_small) {
        if (text.rfind("culet " + std::string(small.command), 0) != 0) continue;
        for (const auto& [option, value] : small.options) {
            if (text.find(option) == std::string::npos) text += " " + option + " " + value;
        }
    }
    return text;
}

class DocsRun : public test::FolderTest, public testing::WithParamInterface<std::string> {
protected:
    fs::path folder() const { return file(""); }

    int sh(const std::string& command) const {
        const std::string line = "cd '" + folder().string() + "' && PATH='" +
                                 fs::path(CULET_PROGRAM).parent_path().string() +
                                 "':$PATH && export PATH && { " + command + "; } >log 2>&1";
        const int status = std::system(line.c_str());
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }

    std::string log() const { return text("log"); }

    // A stone whose readings are filled in, in place of a form that a command wrote.
    void put_stone() const {
        for (const char* name : {"hand.obj", "readings.csv", "stone.toml", "job.toml"})
            fs::copy_file(k_source / "samples/dravite-step" / name, folder() / name,
                          fs::copy_options::overwrite_existing);
    }

    // The files that the pages' commands name, from the dravite sample and standard cuts.
    void SetUp() override {
        const fs::path sample = k_source / "samples/dravite-step";
        fs::create_directory_symlink(k_source / "samples", folder() / "samples");
        put_stone();
        for (const char* name : {"photo.png", "photo.tif", "simulated-photo.png"})
            fs::copy(sample / "simulated-photo.png", folder() / name);
        std::stringstream scene;
        scene << std::ifstream(sample / "scene.toml").rdbuf();
        const std::string shown =
            std::regex_replace(scene.str(), std::regex("stone = \"stone.toml\""),
                               "mesh = \"fitted.obj\"\nmaterial = \"tourmaline_dravite\"");
        ASSERT_NE(shown, scene.str());
        for (const char* name : {"scene.toml", "posed.toml", "other-lights.toml"})
            std::ofstream(folder() / name)
                << std::regex_replace(shown, std::regex("size = .480, 400."), "size = [120, 100]");
        ASSERT_EQ(sh("culet fit stone.toml -o fitted.obj --report fit.json && mkdir stones designs"
                     " && for n in stone start; do culet cut round-brilliant -o $n.obj; done"
                     " && for n in oval emerald; do culet cut $n -o $n.obj; done"
                     " && mv emerald.obj step.obj && cp oval.obj step.obj stones"
                     " && for n in design old new; do culet cut emerald -o $n.asc; done"
                     " && cp old.asc new.asc designs"),
                  0)
            << log();
    }
};

TEST_P(DocsRun, CommandsDoWhatThePageSays) {
    for (const std::string& command : commands_of(k_source / GetParam())) {
        put_stone();
        const int code = sh(made_small(command));
        EXPECT_TRUE(code == 0 || code == 1) << GetParam() << ": " << command << "\n" << log();
    }
}

std::vector<std::string> pages() {
    std::vector<std::string> found = {"README.md", "samples/README.md"};
    for (const auto& entry : fs::directory_iterator(k_source / "docs")) {
        if (entry.path().extension() == ".md")
            found.push_back("docs/" + entry.path().filename().string());
    }
    std::erase_if(found,
                  [](const std::string& page) { return commands_of(k_source / page).empty(); });
    std::sort(found.begin(), found.end());
    return found;
}

INSTANTIATE_TEST_SUITE_P(Pages, DocsRun, testing::ValuesIn(pages()), [](const auto& page) {
    return std::regex_replace(page.param, std::regex("[^A-Za-z]"), "");
});

}  // namespace
}  // namespace culet
