#include "stone/text/name_suggestions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace culet {

namespace {

// The cost of edit distances is the product of lengths.
constexpr std::size_t k_longest_word = 64;

// Lower case, with every run of characters other than letters and digits as one blank.
std::string plain(std::string_view text) {
    std::string result;
    for (const char c : text) {
        const auto u = static_cast<unsigned char>(c);
        if (std::isalnum(u) || u >= 0x80) {
            result += static_cast<char>(std::tolower(u));
        } else if (!result.empty() && result.back() != ' ') {
            result += ' ';
        }
    }
    if (!result.empty() && result.back() == ' ') result.pop_back();
    return result;
}

std::vector<std::string> plain_words(const std::string& plain_text) {
    std::vector<std::string> words(1);
    for (const char c : plain_text) {
        if (c == ' ') {
            words.emplace_back();
        } else {
            words.back() += c;
        }
    }
    return words;
}

}  // namespace

std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t above = row[j];
            row[j] = std::min({row[j] + 1, row[j - 1] + 1,
                               diagonal + static_cast<std::size_t>(a[i - 1] != b[j - 1])});
            diagonal = above;
        }
    }
    return row[b.size()];
}

std::optional<std::string> nearest_name(std::string_view word,
                                        const std::vector<std::string>& known) {
    std::optional<std::string> best;
    std::size_t best_distance = std::max<std::size_t>(2, word.size() / 2) + 1;
    for (const std::string& name : known) {
        const std::size_t distance = edit_distance(word, name);
        if (distance < best_distance) {
            best_distance = distance;
            best = name;
        }
    }
    return best;
}

bool same_words(std::string_view a, std::string_view b) {
    return plain(a) == plain(b);
}

bool holds_whole_words(std::string_view text, std::string_view words) {
    return (' ' + plain(text) + ' ').find(' ' + plain(words) + ' ') != std::string::npos;
}

bool holds_words(std::string_view text, std::string_view words) {
    const std::string held = plain(text);
    const std::vector<std::string> wanted = plain_words(plain(words));
    return std::all_of(wanted.begin(), wanted.end(), [&held](const std::string& word) {
        return held.find(word) != std::string::npos;
    });
}

std::vector<std::string> names_like(std::string_view word, const std::vector<std::string>& known) {
    const std::string wanted = plain(word.substr(0, k_longest_word));
    std::vector<std::string> found;
    if (wanted.empty()) return found;
    for (const std::string& name : known) {
        if (plain(name).starts_with(wanted)) found.push_back(name);
    }
    if (!found.empty()) return found;
    for (const std::string& name : known) {
        if (holds_words(name, wanted)) found.push_back(name);
    }
    if (!found.empty()) return found;
    // A slip or two in a whole name or in one part (saphire is near sapphire_blue). With more than
    // a third of the letters every short name is near every other.
    std::size_t least = std::max<std::size_t>(1, wanted.size() / 3) + 1;
    for (const std::string& name : known) {
        const std::string whole = plain(name);
        std::size_t distance = edit_distance(wanted, whole);
        for (const std::string& part : plain_words(whole)) {
            if (part.size() > 3) distance = std::min(distance, edit_distance(wanted, part));
        }
        if (distance > least || (distance == least && found.empty())) continue;
        if (distance < least) found.clear();
        least = distance;
        found.push_back(name);
    }
    return found;
}

std::string listed(const std::vector<std::string>& names, std::size_t most) {
    if (names.empty()) return {};
    const std::size_t shown = std::min(names.size(), most);
    std::vector<std::string> parts;
    for (std::size_t i = 0; i < shown; ++i) parts.push_back(fmt::format("\"{}\"", names[i]));
    if (names.size() > shown) parts.push_back(fmt::format("{} more", names.size() - shown));
    std::string text = parts.front();
    for (std::size_t i = 1; i < parts.size(); ++i) {
        text += (i + 1 == parts.size() ? " or " : ", ") + parts[i];
    }
    return text;
}

}  // namespace culet
