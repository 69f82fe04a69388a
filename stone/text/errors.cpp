#include "stone/text/errors.h"

#include <fmt/format.h>

#include "stone/text/text_decoding.h"

namespace culet {

InputError::InputError(const std::filesystem::path& file, const std::string& message)
    : std::runtime_error(file.string() + ": " + message) {}

InputError::InputError(const std::filesystem::path& file, long line, const std::string& message)
    : std::runtime_error(file.string() + ":" + std::to_string(line) + ": " + message) {}

namespace {

constexpr std::size_t k_longest_quote = 120, k_longest_line = 2000;

// Where the first `count` characters of UTF-8 end.
std::size_t end_of(std::string_view text, std::size_t count) {
    std::size_t at = 0;
    for (; count > 0 && at < text.size(); --count) next_code_point(text, at);
    return at;
}

std::string shortened(std::string_view text, std::size_t longest) {
    std::size_t count = 0;
    for (std::size_t at = 0; at < text.size(); ++count) next_code_point(text, at);
    if (count <= longest) return std::string(text);
    const std::size_t end = longest / 4;
    return std::string(text.substr(0, end_of(text, longest - end - 3))) + "..." +
           std::string(text.substr(end_of(text, count - end)));
}

}  // namespace

std::string for_terminal(std::string_view text, bool ascii) {
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
    std::string safe;
    for (std::size_t at = 0; at < line.size();) {
        const std::size_t start = at;
        const std::int32_t code = next_code_point(line, at);
        if (code < 0) {
            safe += fmt::format("\\x{:02x}", static_cast<unsigned char>(line[start]));
        } else if (code < 0x20 || (code >= 0x7f && code < 0xa0)) {
            safe.append(at - start, ' ');  // C1 too: some terminals obey it like ESC
        } else if (!is_printable(code) || (ascii && code >= 0x80)) {
            safe += fmt::format("\\u{:04x}", code);
        } else {
            safe += std::string_view(line).substr(start, at - start);
        }
    }
    return safe;
}

}  // namespace culet
