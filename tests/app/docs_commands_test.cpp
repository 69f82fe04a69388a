// Every `culet COMMAND ... --option` in the Markdown files names a command and options that its
// help lists. Expectation: the program's help.

#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "tests/app/program_test.h"
#include "tests/app/written_lines.h"

namespace culet {
namespace {

namespace fs = std::filesystem;

struct WrittenCommand {
    std::string where, command;
    std::vector<std::string> options;
};

// "culet fit stone.toml --report FIT.json" as its command and options, anywhere in a line. It ends
// at a backtick, a comment, a pipe or the end of a line that "\" does not continue.
std::vector<WrittenCommand> commands_in(const fs::path& file) {
    std::vector<WrittenCommand> found;
    for (const auto& [number, line] : test::written_lines(file)) {
        const std::regex call(R"re((?:^|[ `/])culet ([a-z]+)((?: [^`#|;&]*)?))re");
        for (std::sregex_iterator it(line.begin(), line.end(), call), end; it != end; ++it) {
            // In prose a verb follows the name of the program.
            const bool is_code = it->position() > 0 || line.rfind("culet ", 0) == 0;
            WrittenCommand written{
                file.string() + ":" + std::to_string(number), (*it)[1].str(), {}};
            const std::string rest = (*it)[2].str();
            const std::regex option(R"re((?:^|[ \[])(--[a-z][a-z-]*))re");
            for (std::sregex_iterator o(rest.begin(), rest.end(), option); o != end; ++o) {
                written.options.push_back((*o)[1].str());
            }
            if (is_code && !written.options.empty()) found.push_back(written);
        }
    }
    return found;
}

std::string help_of(const std::string& command, std::map<std::string, std::string>& known) {
    auto it = known.find(command);
    if (it == known.end()) {
        const test::ProgramRun run = test::run_culet({command, "--help"});
        std::string text = run.exit_code == 0 ? run.out + run.err : "";
        // Every cut has its own parameters.
        if (command == "cut") text += test::run_culet({"cut", "round-brilliant", "--help"}).out;
        it = known.emplace(command, text).first;
    }
    return it->second;
}

TEST(DocsCommands, NameCommandsAndOptionsThatTheProgramHas) {
    std::map<std::string, std::string> help;
    int commands = 0;
    for (auto it = fs::recursive_directory_iterator(CULET_SOURCE_DIR);
         it != fs::recursive_directory_iterator(); ++it) {
        const std::string name = it->path().filename().string();
        const bool made = it.depth() == 0 && (name.rfind("build", 0) == 0 || name == "out");
        if (it->is_directory() && (made || name == ".git")) it.disable_recursion_pending();
        if (it->path().extension() != ".md" || name == "CHANGELOG.md") continue;
        for (const WrittenCommand& written : commands_in(it->path())) {
            ++commands;
            const std::string text = help_of(written.command, help);
            EXPECT_FALSE(text.empty()) << written.where << ": culet " << written.command;
            for (const std::string& option : written.options) {
                EXPECT_TRUE(std::regex_search(text, std::regex(option + R"re((?![a-z-]))re")))
                    << written.where << ": culet " << written.command << " has no " << option;
            }
        }
    }
    EXPECT_GT(commands, 40);
}

}  // namespace
}  // namespace culet
