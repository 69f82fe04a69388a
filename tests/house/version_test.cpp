// The version stands in CMakeLists.txt, whence the program, its pages, the packages and the Python
// module have it. Two files that are read without a build repeat it. Expectation: the first line of
// CMakeLists.txt that names a project.

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <regex>
#include <string>

namespace {

std::string first_match(const std::string& file, const std::string& pattern) {
    std::ifstream in(std::string(CULET_SOURCE_DIR) + "/" + file);
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    std::smatch found;
    return std::regex_search(text, found, std::regex(pattern)) ? found[1].str() : "";
}

TEST(Version, IsTheSameWhereverItStands) {
    const std::string version =
        first_match("CMakeLists.txt", R"re(project\(culet VERSION ([0-9.]+))re");
    ASSERT_NE(version, "");
    EXPECT_EQ(first_match("CITATION.cff", R"re(\nversion: (\S+))re"), version);
    // The newest section of the changes is closed: it has a date, and the citation has the same.
    EXPECT_EQ(first_match("CHANGELOG.md", R"re(\n## (\S+) \(\d{4}-\d\d-\d\d\)\n)re"), version);
    EXPECT_EQ(first_match("CHANGELOG.md", R"re(\n## \S+ \((.*)\))re"),
              first_match("CITATION.cff", R"re(\ndate-released: (\S+))re"));
}

}  // namespace
