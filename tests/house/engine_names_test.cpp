// An engine's name is defined once (render/scene/engine_name.h, and the engine itself). Code
// elsewhere that compares or sets an engine uses the constant, so that a new engine touches no
// other file.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <string>

namespace {

namespace fs = std::filesystem;

TEST(EngineNames, StandInNoOtherFileAsText) {
    const std::regex as_text(R"re(engine\w*\s*(==|!=|=)\s*"|"\s*(==|!=)\s*\w*engine)re");
    int files = 0;
    for (const char* room : {"render", "compare", "app"}) {
        for (const auto& entry :
             fs::recursive_directory_iterator(fs::path(CULET_SOURCE_DIR) / room)) {
            const fs::path& file = entry.path();
            if (file.extension() != ".h" && file.extension() != ".cpp") continue;
            if (file.filename() == "engine_name.h") continue;
            ++files;
            std::ifstream text(file);
            std::string line;
            for (int number = 1; std::getline(text, line); ++number) {
                // Texts for people may say `engine = "..."`, with an escaped quote.
                line = std::regex_replace(line, std::regex(R"re(\\")re"), "'");
                EXPECT_FALSE(std::regex_search(line, as_text))
                    << file.string() << ":" << number << ": " << line;
            }
        }
    }
    EXPECT_GT(files, 300);
}

}  // namespace
