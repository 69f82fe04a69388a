// Words that the code once had of its own, where the field has a word: none comes back, neither as
// a name nor in a comment. docs/glossary.md has the field's words.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

struct Retired {
    const char* pattern;  ///< a whole word of code or comment
    const char* instead;
};

const std::vector<Retired> k_everywhere = {
    {"PlaneKnowledge", "plane observations"},
    {"come_to_nothing|comes? to nothing", "degenerate facets"},
    {"is_an_end|near_an_end", "local minimum"},
    {"put_back\\w*", "restore"},
    {"bends_|curved_|pressed_", "Lagrangian Hessian, working set"},
    {"k_crumb|k_dust|k_hurry", "stall tolerances"},
    {"Folded|ways_to_lean", "sign ambiguity"},
    {"Loosened", "inflated covariance"},
    {"Standing", "azimuth prior, orientation"},
    {"open directions?", "unobservable directions"},
    {"furnished\\w*|Furnished\\w*", "has objects"},
    {"parted|Parted\\w*", "split waves"},
    {"OtherWorlds|NullWorth|other worlds?|null worth", "alternatives, null statistics"},
    {"\\w*Witness\\w*|witness(es)?", "correspondence"},
    {"rungs?|ladders?", "refinement level"},
    {"Pace|paced|\\w*Allowance\\w*", "time budget"},
    {"the judge", "reference, error metric"},
};
// Words that mean something else in other rooms.
const std::vector<std::pair<const char*, Retired>> k_in_rooms = {
    {"fit/solve", {"forces?_?", "Lagrange multipliers"}},
    {"render", {"leaf|leaves|Leaf\\w*", "exit event"}},
    {"render", {"Account", "energy balance"}},
    {"compare", {"stretch(ed)?", "variance-stabilising transform"}},
};

std::vector<std::string> found_in(const fs::path& room, const Retired& word) {
    const std::regex whole(std::string("(^|[^A-Za-z0-9_])(") + word.pattern + ")([^A-Za-z0-9_]|$)");
    std::vector<std::string> found;
    for (const auto& entry : fs::recursive_directory_iterator(room)) {
        const fs::path& file = entry.path();
        if (file.extension() != ".h" && file.extension() != ".cpp") continue;
        std::ifstream text(file);
        std::string line;
        for (int number = 1; std::getline(text, line); ++number) {
            if (std::regex_search(line, whole))
                found.push_back(file.string() + ":" + std::to_string(number) + ": " + line);
        }
    }
    return found;
}

TEST(RetiredWords, DoNotComeBack) {
    const fs::path source = CULET_SOURCE_DIR;
    for (const char* room : {"stone", "fit", "render", "compare", "refine", "app", "page"}) {
        for (const Retired& word : k_everywhere) {
            for (const std::string& line : found_in(source / room, word))
                ADD_FAILURE() << line << "\nsay: " << word.instead;
        }
    }
    for (const auto& [room, word] : k_in_rooms) {
        for (const std::string& line : found_in(source / room, word))
            ADD_FAILURE() << line << "\nsay: " << word.instead;
    }
}

// The search finds what it is for.
TEST(RetiredWords, AreFoundWhereTheyStand) {
    EXPECT_FALSE(found_in(CULET_SOURCE_DIR "/tests/house", {"k_everywhere", ""}).empty());
    EXPECT_TRUE(found_in(CULET_SOURCE_DIR "/tests/house", {"k_every", ""}).empty());
}

}  // namespace
