#include "stone/text/toml_keys.h"

namespace culet {

namespace {

// Past the closing quote of the string that begins at `from`, or the text's end. Strings in three
// quotes may span lines; others end with theirs.
std::size_t end_of_string(std::string_view text, std::size_t from) {
    const char quote = text[from];
    const bool is_long = text.substr(from, 3) == std::string_view(quote == '"' ? "\"\"\"" : "'''");
    std::size_t i = from + (is_long ? 3 : 1);
    for (; i < text.size(); ++i) {
        if (quote == '"' && text[i] == '\\') {
            ++i;
        } else if (!is_long && text[i] == '\n') {
            return i;
        } else if (text[i] == quote) {
            if (!is_long) return i + 1;
            if (text.substr(i, 3) == text.substr(from, 3)) return i + 3;
        }
    }
    return text.size();
}

}  // namespace

long line_of_deep_key(std::string_view text, std::size_t most) {
    long line = 1;
    std::size_t parts = 1;
    for (std::size_t i = 0; i < text.size();) {
        const char c = text[i];
        if (c == '"' || c == '\'') {
            const std::size_t end = end_of_string(text, i);
            for (; i < end; ++i) line += text[i] == '\n';
            continue;
        }
        if (c == '#') {
            while (i < text.size() && text[i] != '\n') ++i;
            continue;
        }
        if (c == '\n') ++line;
        if (c == '.' && ++parts > most) return line;
        if (c == '\n' || c == '=' || c == ',' || c == '{' || c == '[') parts = 1;
        ++i;
    }
    return 0;
}

}  // namespace culet
