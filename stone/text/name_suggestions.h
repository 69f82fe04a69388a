#pragma once
// Suggests what somebody may have meant by an unknown name.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace culet {

/// Levenshtein (1966): fewest insertions, deletions and replacements from one word to the other.
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The name in `known` with the least edit distance to `word`, or nothing when none is near.
std::optional<std::string> nearest_name(std::string_view word,
                                        const std::vector<std::string>& known);

/// The names that may be meant by `word`, best first: those that begin with its words; else those
/// that contain all of them (`blue sapphire` is sapphire_blue); else the nearest by edit distance,
/// of the whole name or a part. Case does not count; `-`, `_` and blanks are equal. Empty when none
/// is near.
std::vector<std::string> names_like(std::string_view word, const std::vector<std::string>& known);

/// True when `text` contains these words in succession, each whole.
bool holds_whole_words(std::string_view text, std::string_view words);

/// True when both are the same words. Case does not count; `-`, `_` and blanks are equal.
bool same_words(std::string_view a, std::string_view b);

/// True when `text` contains every word of `words` in any case.
bool holds_words(std::string_view text, std::string_view words);

/// `"a"`, `"a" or "b"`, `"a", "b" or 5 more`: at most `most` quoted names; empty without names.
std::string listed(const std::vector<std::string>& names, std::size_t most = 4);

}  // namespace culet
