#pragma once
// Suggests what somebody may have meant by an unknown name.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace culet {

/// Levenshtein (1966): insertions, deletions and replacements.
std::size_t edit_distance(std::string_view a, std::string_view b);

/// By edit distance; nothing when none is near.
std::optional<std::string> nearest_name(std::string_view word,
                                        const std::vector<std::string>& known);

/// What `word` may mean, best first: names that begin with its words; else that contain all of them
/// (`blue sapphire` is sapphire_blue); else the nearest by edit distance, whole or in part. Case
/// does not count; `-`, `_` and blanks are equal.
std::vector<std::string> names_like(std::string_view word, const std::vector<std::string>& known);

/// In succession.
bool holds_whole_words(std::string_view text, std::string_view words);

/// Case does not count; `-`, `_` and blanks are equal.
bool same_words(std::string_view a, std::string_view b);

/// In any order and case.
bool holds_words(std::string_view text, std::string_view words);

/// `"a"`, `"a" or "b"`, `"a", "b" or 5 more`: at most `most` quoted names; empty without names.
std::string listed(const std::vector<std::string>& names, std::size_t most = 4);

}  // namespace culet
