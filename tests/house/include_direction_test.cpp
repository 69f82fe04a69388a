// Dependencies point one way: a file includes its own room and the rooms that it may see.
// Expectation: the table of rooms in docs/architecture.md.

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
    {"page", {"page", "stone"}},
    {"fit", {"fit", "stone"}},
    {"render", {"render", "stone"}},
    {"viewer", {"viewer", "page", "render", "stone"}},
    {"compare", {"compare", "viewer", "page", "render", "stone"}},
    {"refine", {"refine", "compare", "page", "render", "fit", "stone"}},
    {"studio", {"studio", "refine", "compare", "viewer", "page", "render", "fit", "stone"}},
    {"app", {"app", "studio", "refine", "compare", "viewer", "page", "render", "fit", "stone"}},
    {"python", {"python", "refine", "compare", "viewer", "page", "render", "fit", "stone"}},
};

bool is_source(const fs::path& file) {
    return file.extension() == ".h" || file.extension() == ".cpp";
}

TEST(Rooms, IncludeOnlyWhatTheyMaySee) {
    const std::regex include_line(R"(^\s*#\s*include\s*"([a-z_]+)/)");
    const std::regex quoted_line(R"(^\s*#\s*include\s*"([^"]+)\")");
    for (const auto& [room, visible] : k_may_see) {
        int files = 0;
        for (const auto& entry :
             fs::recursive_directory_iterator(fs::path(CULET_SOURCE_DIR) / room)) {
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

// A file's includes of its own room, as paths from the source folder.
std::set<std::string> includes_of(const fs::path& file) {
    const std::regex quoted_line(R"(^\s*#\s*include\s*"([^"]+)\")");
    std::set<std::string> found;
    std::ifstream text(file);
    std::smatch match;
    for (std::string line; std::getline(text, line);) {
        if (std::regex_search(line, match, quoted_line)) found.insert(match[1]);
    }
    return found;
}

// Heavy libraries stay behind small headers: headers that a room shows to other rooms, with all
// their includes, contain only lower rooms, GLM and the standard library (docs/architecture.md).
// Headers inside a room may use Eigen or OpenCV. The one exception is small dense algebra: its
// header includes <Eigen/Core>, which is cheap, so that Eigen's expensive decompositions compile
// once for all rooms.
const std::string k_shows_eigen = "stone/numbers/dense_algebra.h";

TEST(Rooms, ShowNoHeavyLibraryToOtherRooms) {
    const std::regex heavy(
        R"(#\s*include\s*<(CGAL|OpenMesh|ceres|Eigen|opencv2|Imath|OpenEXR|Imf|toml\+\+|nlohmann|kainjow|httplib|tbb))");
    const fs::path source(CULET_SOURCE_DIR);
    std::set<std::string> shown, open;
    for (const auto& [room, visible] : k_may_see) {
        for (const auto& entry : fs::recursive_directory_iterator(source / room)) {
            if (!is_source(entry.path())) continue;
            // In WebAssembly these replace files of other rooms, so they include those rooms'
            // private headers.
            if (entry.path().filename() == "stand_ins.cpp") continue;
            for (const std::string& header : includes_of(entry.path())) {
                if (!header.starts_with(room + "/")) open.insert(header);
            }
        }
    }
    while (!open.empty()) {
        const std::string header = *open.begin();
        open.erase(open.begin());
        if (!shown.insert(header).second) continue;
        for (const std::string& next : includes_of(source / header)) open.insert(next);
    }
    EXPECT_GT(shown.size(), 10u);
    for (const std::string& header : shown) {
        std::ifstream text(source / header);
        ASSERT_TRUE(text) << header;
        std::string line;
        for (int number = 1; std::getline(text, line); ++number) {
            if (header == k_shows_eigen && line == "#include <Eigen/Core>") continue;
            EXPECT_FALSE(std::regex_search(line, heavy)) << header << ":" << number << ": " << line;
        }
    }
}

// Folders of a room do not include each other in cycles; files outside of folders count as one.
TEST(Rooms, HaveFoldersThatIncludeEachOtherOneWay) {
    const fs::path source(CULET_SOURCE_DIR);
    for (const std::string room : {"stone", "page", "fit", "render", "viewer", "compare", "refine",
                                   "studio", "app", "python"}) {
        // For each folder those that it includes, directly or through others.
        std::map<std::string, std::set<std::string>> seen_from;
        for (const auto& entry : fs::recursive_directory_iterator(source / room)) {
            if (!is_source(entry.path())) continue;
            const std::string own = fs::relative(entry.path(), source).parent_path().string();
            for (const std::string& header : includes_of(entry.path())) {
                const std::string other = fs::path(header).parent_path().string();
                if (header.starts_with(room + "/") && other != own) seen_from[own].insert(other);
            }
        }
        for (bool grows = true; grows;) {
            grows = false;
            for (auto& [folder, seen] : seen_from) {
                const std::set<std::string> before = seen;
                for (const std::string& next : before) {
                    const auto further = seen_from.find(next);
                    if (further == seen_from.end()) continue;
                    seen.insert(further->second.begin(), further->second.end());
                }
                grows = grows || seen.size() > before.size();
            }
        }
        for (const auto& [folder, seen] : seen_from) {
            EXPECT_EQ(seen.count(folder), 0u) << folder << " includes itself through others";
        }
    }
}

// Benches are built on demand: they may use the tests' helper files, and no test needs them.
TEST(Rooms, AndTheirTestsNeedNoBench) {
    const fs::path source(CULET_SOURCE_DIR);
    for (const std::string folder : {"tests", "examples"}) {
        for (const auto& entry : fs::recursive_directory_iterator(source / folder)) {
            if (!is_source(entry.path())) continue;
            for (const std::string& header : includes_of(entry.path()))
                EXPECT_FALSE(header.starts_with("bench/")) << entry.path() << ": " << header;
        }
    }
}

// Pages are made from template files (templates/*.html.mustache), which escape by default: no
// string of the program contains a tag. Exceptions: drawings are SVG, made where they are computed;
// Mitsuba's scenes are XML.
TEST(Rooms, KeepHtmlInTemplateFiles) {
    const std::set<std::string> drawings{"page/chart.cpp", "page/drawing.cpp",
                                         "compare/photo/calibration_board.cpp",
                                         "render/export/mitsuba.cpp"};
    const std::regex quotes(R"re('\\?"')re"), literal(R"re("(?:[^"\\]|\\.)*")re");
    const std::regex tag(R"re(<(/?[a-z][a-z0-9]*(>|/>| [a-z-]+=)|!doctype))re");
    const fs::path source(CULET_SOURCE_DIR);
    for (const auto& [room, visible] : k_may_see) {
        for (const auto& entry : fs::recursive_directory_iterator(source / room)) {
            if (!is_source(entry.path())) continue;
            const std::string name = fs::relative(entry.path(), source).string();
            if (drawings.contains(name)) continue;
            std::ifstream text(entry.path());
            std::string line;
            for (int number = 1; std::getline(text, line); ++number) {
                const std::size_t begin = line.find_first_not_of(' ');
                if (begin != std::string::npos && line.compare(begin, 2, "//") == 0) continue;
                const std::string code = std::regex_replace(line, quotes, "");
                for (std::sregex_iterator at(code.begin(), code.end(), literal), end; at != end;
                     ++at) {
                    EXPECT_FALSE(std::regex_search(at->str(), tag))
                        << name << ":" << number << ": " << line;
                }
            }
        }
    }
}

}  // namespace
