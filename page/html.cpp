#include "page/html.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>

#include "stone/text/text_decoding.h"

namespace culet {

namespace {

constexpr const char* k_base64 = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

const char* const k_minus = "\xe2\x88\x92";
const char* const k_dash = "\xe2\x80\x93";

std::string with_true_minus(std::string number) {
    // Writes 0.00 instead of -0.00.
    if (number.find_first_of("123456789") == std::string::npos && number.starts_with('-')) {
        number.erase(0, 1);
    }
    for (std::size_t at = number.find('-'); at != std::string::npos; at = number.find('-', at)) {
        number.replace(at, 1, k_minus);
        at += 3;
    }
    return number;
}

}  // namespace

std::string escaped(std::string_view text) {
    std::string result;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t start = at;
        const bool valid = next_code_point(text, at) >= 0;
        const char c = text[start];
        if (!valid) {
            result += "\xef\xbf\xbd";
        } else if (c == '&') {
            result += "&amp;";
        } else if (c == '<') {
            result += "&lt;";
        } else if (c == '>') {
            result += "&gt;";
        } else if (c == '"') {
            result += "&quot;";
        } else if (c == '\'') {
            result += "&#39;";
        } else if ((static_cast<std::uint8_t>(c) < 0x20 && c != '\n' && c != '\t') || c == 0x7f) {
            result += "\xef\xbf\xbd";
        } else {
            result += text.substr(start, at - start);
        }
    }
    return result;
}

std::string json_for_script(std::string_view json) {
    std::string result;
    for (const char c : json) {
        if (c == '<') {
            result += "\\u003c";
        } else {
            result += c;
        }
    }
    return result;
}

std::string base64(std::string_view bytes) {
    const char* const alphabet = k_base64;
    std::string result;
    result.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t group = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            group =
                group << 8 | (i + k < bytes.size() ? static_cast<std::uint8_t>(bytes[i + k]) : 0u);
        }
        for (std::size_t k = 0; k < 4; ++k) {
            const bool padding = i + k > bytes.size();
            result += padding ? '=' : alphabet[group >> (18 - 6 * k) & 63];
        }
    }
    return result;
}

std::optional<std::string> bytes_of_base64(std::string_view text) {
    if (text.size() % 4 != 0) return std::nullopt;
    const std::string_view alphabet = k_base64;
    std::string bytes;
    bytes.reserve(text.size() / 4 * 3);
    for (std::size_t i = 0; i < text.size(); i += 4) {
        const bool last = i + 4 == text.size();
        const std::size_t padding = !last || text[i + 3] != '=' ? 0 : (text[i + 2] == '=' ? 2 : 1);
        std::uint32_t group = 0;
        for (std::size_t k = 0; k < 4; ++k) {
            const std::size_t value = k + padding < 4 ? alphabet.find(text[i + k]) : 0;
            if (value == std::string_view::npos) return std::nullopt;
            group = group << 6 | static_cast<std::uint32_t>(value);
        }
        for (std::size_t k = 0; k + padding < 3; ++k)
            bytes += static_cast<char>(group >> (16 - 8 * k) & 0xff);
    }
    return bytes;
}

std::string png_uri(std::string_view png) {
    return "data:image/png;base64," + base64(png);
}

std::string picture_uri(std::string_view file) {
    if (file.starts_with("\x89PNG")) return png_uri(file);
    if (file.starts_with("\xff\xd8\xff")) return "data:image/jpeg;base64," + base64(file);
    return {};
}

std::string shell_word(const std::string& word) {
    const bool plain = !word.empty() && std::all_of(word.begin(), word.end(), [](unsigned char c) {
        return std::isalnum(c) || std::string_view("._-/=+:,").find(char(c)) != std::string::npos;
    });
    if (plain) return word;
    std::string text = "'";
    for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return text + "'";
}

std::string as_sentence(std::string text) {
    if (text.empty()) return text;
    text.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(text.front())));
    return text.back() == '.' ? text : text + ".";
}

std::string decimals(const std::optional<double>& value, int count) {
    if (!value || !std::isfinite(*value)) return k_dash;
    return with_true_minus(fmt::format("{:.{}f}", *value, count));
}

std::string whole(const std::optional<double>& value) {
    return decimals(value, 0);
}

std::string significant(const std::optional<double>& value, int count) {
    if (!value || !std::isfinite(*value)) return k_dash;
    if (*value == 0) return "0";
    const double magnitude = std::floor(std::log10(std::abs(*value)));
    if (magnitude < -5 || magnitude > 7) {
        return with_true_minus(fmt::format("{:.{}e}", *value, count - 1));
    }
    const int places = std::max(0, count - 1 - static_cast<int>(magnitude));
    return with_true_minus(fmt::format("{:.{}f}", *value, places));
}

}  // namespace culet
