// Dependencies point one way: a file includes its own room and the floors it may see.
// Source of the expectation: the table of rooms in docs/architecture.md.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>

namespace {

namespace fs = std::filesystem;

const std::map<std::string, std::set<std::string>> k_may_see = {
    {"stone", {"stone"}},
    {"fit", {"fit", "stone"}},
    {"render", {"render", "stone"}},
    {"compare", {"compare", "render", "stone"}},
    {"app", {"app", "compare", "render", "fit", "stone"}},
};

bool is_source(const fs::path& file) {
    return file.extension() == ".h" || file.extension() == ".cpp";
}

TEST(Rooms, include_only_what_they_may_see) {
    const std::regex include_line(R"(^\s*#\s*include\s*"([a-z_]+)/)");
    const std::regex quoted_line(R"(^\s*#\s*include\s*"([^"]+)\")");
    for (const auto& [room, visible] : k_may_see) {
        int files = 0;
        for (const auto& entry : fs::recursive_directory_iterator(fs::path(CULET_SOURCE_DIR) / room)) {
            if (!is_source(entry.path())) continue;
            ++files;
            std::ifstream text(entry.path());
            std::string line;
            for (int number = 1; std::getline(text, line); ++number) {
                std::smatch match;
                if (!std::regex_search(line, match, quoted_line)) continue;
                ASSERT_TRUE(std::regex_search(line, match, include_line))
                    << entry.path() << ":" << number << ": name the room in the include: " << line;
                EXPECT_TRUE(visible.count(match[1].str()) == 1)
                    << entry.path() << ":" << number << ": " << room << " may not see " << match[1];
            }
        }
        EXPECT_GT(files, 0) << "room " << room << " is empty";
    }
}

// Heavy libraries stay behind small headers: a public header shows only lower rooms, GLM and the
// standard library (docs/architecture.md). `app` is no library and may show its option parser.
TEST(Rooms, keep_heavy_libraries_out_of_headers) {
    const std::regex heavy(R"(#\s*include\s*<(CGAL|OpenMesh|ceres|Eigen|opencv2|Imath|OpenEXR|Imf|toml\+\+|nlohmann|tbb))");
    for (const std::string room : {"stone", "fit", "render", "compare"}) {
        for (const auto& entry : fs::recursive_directory_iterator(fs::path(CULET_SOURCE_DIR) / room)) {
            if (entry.path().extension() != ".h") continue;
            if (entry.path().filename().string().ends_with("_internal.h")) continue;
            std::ifstream text(entry.path());
            std::string line;
            for (int number = 1; std::getline(text, line); ++number) {
                EXPECT_FALSE(std::regex_search(line, heavy)) << entry.path() << ":" << number << ": " << line;
            }
        }
    }
}

}  // namespace
