#include "stone/errors.h"

namespace culet {

InputError::InputError(const std::filesystem::path& file, const std::string& message)
    : std::runtime_error(file.string() + ": " + message) {}

InputError::InputError(const std::filesystem::path& file, long line, const std::string& message)
    : std::runtime_error(file.string() + ":" + std::to_string(line) + ": " + message) {}

namespace {

constexpr std::size_t k_longest_quote = 120, k_longest_line = 2000;

// The first or last `size` bytes at most, to a whole character of UTF-8.
std::string_view head(std::string_view text, std::size_t size) {
    if (text.size() <= size) return text;
    while (size > 0 && (static_cast<unsigned char>(text[size]) & 0xc0) == 0x80) --size;
    return text.substr(0, size);
}
std::string_view tail(std::string_view text, std::size_t size) {
    if (text.size() <= size) return text;
    std::size_t from = text.size() - size;
    while (from < text.size() && (static_cast<unsigned char>(text[from]) & 0xc0) == 0x80) ++from;
    return text.substr(from);
}

std::string shortened(std::string_view text, std::size_t longest) {
    if (text.size() <= longest) return std::string(text);
    const std::size_t end = longest / 4;
    return std::string(head(text, longest - end - 3)) + "..." + std::string(tail(text, end));
}

}  // namespace

std::string for_terminal(std::string_view text) {
    std::string line;
    while (!text.empty()) {
        const std::size_t open = text.find('"');
        line += text.substr(0, open);
        if (open == std::string_view::npos) break;
        text.remove_prefix(open + 1);
        const std::size_t close = text.find('"');
        line += '"' + shortened(text.substr(0, close), k_longest_quote);
        if (close == std::string_view::npos) break;
        line += '"';
        text.remove_prefix(close + 1);
    }
    line = shortened(line, k_longest_line);
    for (std::size_t i = 0; i < line.size(); ++i) {
        const auto c = static_cast<unsigned char>(line[i]);
        if (c < 0x20 || c == 0x7f) line[i] = ' ';
        // U+0080 to U+009F, which some terminals obey like ESC.
        if (c == 0xc2 && i + 1 < line.size() && static_cast<unsigned char>(line[i + 1]) < 0xa0)
            line[i] = line[i + 1] = ' ';
    }
    return line;
}

}  // namespace culet
