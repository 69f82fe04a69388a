#pragma once
// The lines of a document, those that a backslash continues joined.

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace culet::test {

struct WrittenLine {
    int number = 0;  ///< of its last part, counted from 1
    std::string text;
};

inline std::vector<WrittenLine> written_lines(const std::filesystem::path& file) {
    std::ifstream in(file);
    std::vector<WrittenLine> lines;
    std::string line;
    int number = 0;
    for (std::string part; std::getline(in, part);) {
        ++number;
        line += part;
        if (!part.empty() && part.back() == '\\') {
            line.back() = ' ';
            continue;
        }
        lines.push_back({number, line});
        line.clear();
    }
    return lines;
}

}  // namespace culet::test
