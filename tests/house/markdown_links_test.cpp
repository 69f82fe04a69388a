// Every relative link and anchor in the repository's Markdown files leads somewhere. Expectation:
// the files themselves; anchors are GitHub's (lower case, blanks become hyphens, punctuation is
// dropped, repeated headings get -1, -2), and `<a id="...">`.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

// Code has no links: it is blanked, and line breaks stay so that line numbers remain right.
std::string without_code(const std::string& text) {
    std::string kept;
    std::istringstream lines(text);
    bool in_fence = false;
    for (std::string line; std::getline(lines, line); kept += '\n') {
        const std::size_t start = line.find_first_not_of(' ');
        if (start != std::string::npos && line.compare(start, 3, "```") == 0) {
            in_fence = !in_fence;
        } else if (!in_fence) {
            bool in_span = false;
            for (const char c : line) {
                if (c == '`') {
                    in_span = !in_span;
                } else if (!in_span) {
                    kept += c;
                }
            }
        }
    }
    return kept;
}

struct Link {
    std::string target;
    int line = 1;
};

std::vector<Link> links_of(const std::string& markdown) {
    const std::string text = without_code(markdown);
    const auto line_of = [&](std::size_t at) {
        const auto end = text.begin() + static_cast<std::ptrdiff_t>(at);
        return 1 + static_cast<int>(std::count(text.begin(), end, '\n'));
    };
    std::vector<Link> links;
    // [text](target "title"), ![picture](target): the target ends at a blank or a parenthesis.
    for (std::size_t at = text.find("]("); at != std::string::npos; at = text.find("](", at + 2)) {
        const std::size_t end = text.find_first_of(" \n)", at + 2);
        links.push_back({text.substr(at + 2, end - at - 2), line_of(at)});
    }
    const std::regex other(R"re((?:src|href)="([^"]+)"|(?:^|\n)\[[^\]\n]+\]:[ \t]*(\S+))re");
    for (std::sregex_iterator it(text.begin(), text.end(), other), end; it != end; ++it) {
        const std::size_t group = (*it)[1].matched ? 1 : 2;
        links.push_back(
            {(*it)[group].str(), line_of(static_cast<std::size_t>(it->position(group)))});
    }
    return links;
}

std::string slug(const std::string& heading) {
    // A link in a heading counts as its text.
    const std::string text =
        std::regex_replace(heading, std::regex(R"re(\[([^\]]*)\]\([^)]*\))re"), "$1");
    std::string slug;
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (std::isalnum(byte) != 0 || byte >= 0x80 || c == '_' || c == '-') {
            slug += static_cast<char>(byte < 0x80 ? std::tolower(byte) : byte);
        } else if (c == ' ') {
            slug += '-';
        }
    }
    return slug;
}

std::set<std::string> anchors_of(const std::string& markdown) {
    std::set<std::string> anchors;
    std::map<std::string, int> met;
    bool in_fence = false;
    std::istringstream lines(markdown);
    for (std::string line; std::getline(lines, line);) {
        if (line.compare(0, 3, "```") == 0) in_fence = !in_fence;
        if (in_fence) continue;
        std::smatch match;
        if (std::regex_match(line, match, std::regex(R"re(#{1,6} +(.*?) *#*)re"))) {
            const std::string name = slug(match[1].str());
            const int before = met[name]++;
            anchors.insert(before == 0 ? name : name + "-" + std::to_string(before));
        }
        const std::regex named(R"re(<a (?:id|name)="([^"]+)")re");
        for (std::sregex_iterator it(line.begin(), line.end(), named), end; it != end; ++it) {
            anchors.insert((*it)[1].str());
        }
    }
    return anchors;
}

std::string content(const fs::path& file) {
    std::ifstream in(file);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
}

std::vector<fs::path> markdown_files() {
    std::vector<fs::path> files;
    const fs::path root(CULET_SOURCE_DIR);
    for (auto it = fs::recursive_directory_iterator(root); it != fs::recursive_directory_iterator();
         ++it) {
        const std::string name = it->path().filename().string();
        const bool made = it.depth() == 0 && (name.rfind("build", 0) == 0 || name == "out");
        if (it->is_directory() && (made || name == ".git")) it.disable_recursion_pending();
        if (it->path().extension() == ".md") files.push_back(it->path());
    }
    std::sort(files.begin(), files.end());
    return files;
}

// The faults in the links of the text at `file`.
std::vector<std::string> faults(const fs::path& file, const std::string& text) {
    std::vector<std::string> faults;
    for (const auto& [target, line] : links_of(text)) {
        if (std::regex_search(target, std::regex(R"re(^[a-z]+:)re"))) continue;  // the web
        const std::size_t hash = target.find('#');
        const std::string path = target.substr(0, hash);
        const fs::path to = path.empty() ? file : file.parent_path() / path;
        const std::string where = file.string() + ":" + std::to_string(line) + ": " + target;
        if (!path.empty() && !fs::exists(to)) {
            faults.push_back(where + ": there is no such file");
        } else if (hash != std::string::npos) {
            const std::string there = path.empty() ? text : content(to);
            if (anchors_of(there).count(target.substr(hash + 1)) == 0) {
                faults.push_back(where + ": there is no such heading");
            }
        }
    }
    return faults;
}

TEST(MarkdownLinks, LeadToFilesAndHeadingsThatAreThere) {
    int links = 0;
    for (const fs::path& file : markdown_files()) {
        const std::string text = content(file);
        links += static_cast<int>(links_of(text).size());
        for (const std::string& fault : faults(file, text)) ADD_FAILURE() << fault;
    }
    EXPECT_GT(links, 100);
}

TEST(MarkdownLinks, OfEveryPageStandInTheTableOfContents) {
    const fs::path docs = fs::path(CULET_SOURCE_DIR) / "docs";
    std::set<std::string> listed;
    for (const Link& link : links_of(content(docs / "README.md"))) listed.insert(link.target);
    for (const auto& entry : fs::directory_iterator(docs)) {
        const std::string name = entry.path().filename().string();
        if (entry.path().extension() != ".md" || name == "README.md") continue;
        EXPECT_EQ(listed.count(name), 1u) << "docs/README.md does not list docs/" << name;
    }
}

// Tests the check itself: it finds broken links of every kind, at their lines, and no others.
TEST(MarkdownLinks, ThatAreBrokenAreFound) {
    const fs::path here = fs::path(CULET_SOURCE_DIR) / "docs" / "README.md";
    const std::string text =
        "# One `two`: three?\n[a](#one-two-three) [b](../LICENSE) [c](https://example.org/x#y)\n"
        "```\n[code](nowhere)\n```\n`[code](nowhere)` <a id=\"term\"></a>[d](#term)\n"
        "[e](no-such-page.md) ![f](no-such.png)\n[g](#no-such) [h](../README.md#no-such)\n"
        "<img src=\"no-such.svg\">\n\n[i]: no-such-reference.md\n# One\n# One\n[j](#one-1)\n";
    const std::vector<std::string> found = faults(here, text);
    const std::vector<std::string> expected = {":7: no-such-page.md", ":7: no-such.png",
                                               ":8: #no-such",        ":8: ../README.md#no-such",
                                               ":9: no-such.svg",     ":11: no-such-reference.md"};
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
        EXPECT_NE(found[i].find(expected[i] + ":"), std::string::npos) << found[i];
    }
}

}  // namespace
