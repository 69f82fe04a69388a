// culet is under the MIT licence, so it may use CGAL's kernels, which are under the LGPL, but none
// of CGAL's packages under the GPL. Expectation: the line SPDX-License-Identifier in CGAL's own
// headers.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <string>

namespace {

namespace fs = std::filesystem;

const std::set<std::string> k_allowed = {
    "CGAL/Exact_predicates_exact_constructions_kernel.h",
    "CGAL/Exact_predicates_inexact_constructions_kernel.h",
    "CGAL/MP_Float.h",
    "CGAL/Simple_cartesian.h",
    "CGAL/Simple_homogeneous.h",
    "CGAL/intersections.h",
};

struct Header {
    std::string licence;
    std::set<std::string> includes;
};

// The text in `line` between `before` and the next of `ends`; empty if there is none.
std::string between(const std::string& line, const std::string& before, const char* ends) {
    const std::size_t at = line.find(before);
    if (at == std::string::npos) return "";
    const std::size_t begin = at + before.size();
    return line.substr(begin, line.find_first_of(ends, begin) - begin);
}

Header read(const fs::path& file) {
    Header header;
    std::ifstream text(file);
    for (std::string line; std::getline(text, line);) {
        for (const char* quote : {"<CGAL/", "\"CGAL/"}) {
            const std::string rest = between(line, quote, ">\"");
            if (!rest.empty() && line.find("include") != std::string::npos)
                header.includes.insert("CGAL/" + rest);
        }
        const std::string licence = between(line, "SPDX-License-Identifier: ", " \r");
        if (!licence.empty()) header.licence = licence;
    }
    return header;
}

TEST(CgalHeaders, AreOfTheAllowedList) {
    const fs::path source(CULET_SOURCE_DIR);
    int found = 0;
    for (const std::string room : {"stone", "page", "fit", "render", "viewer", "compare", "refine",
                                   "app", "python", "tests", "bench", "examples", "samples"}) {
        for (const auto& entry : fs::recursive_directory_iterator(source / room)) {
            const auto extension = entry.path().extension();
            if (extension != ".h" && extension != ".cpp") continue;
            for (const std::string& header : read(entry.path()).includes) {
                ++found;
                EXPECT_TRUE(k_allowed.contains(header))
                    << entry.path() << " includes " << header
                    << ": see that its package is under the LGPL, then add it to this list";
            }
        }
    }
    EXPECT_GT(found, 0);
}

// Also covers what the allowed headers include, under any condition.
TEST(CgalHeaders, AreUnderTheLgplWithAllThatTheyInclude) {
    std::set<std::string> open = k_allowed, seen;
    while (!open.empty()) {
        const std::string name = *open.begin();
        open.erase(open.begin());
        const fs::path file = fs::path(CULET_CGAL_FOLDER) / name;
        if (!seen.insert(name).second) continue;
        // Some headers come only with other compilers or CGAL's own tests.
        if (!fs::exists(file) && !k_allowed.contains(name)) continue;
        const Header header = read(file);
        EXPECT_TRUE(header.licence.starts_with("LGPL") || header.licence == "BSL-1.0")
            << file << ": " << (header.licence.empty() ? "no licence" : header.licence);
        open.insert(header.includes.begin(), header.includes.end());
    }
    EXPECT_GT(seen.size(), 100u);
}

}  // namespace
