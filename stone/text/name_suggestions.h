#pragma once
// Suggests what somebody may have meant by an unknown name.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace culet {

/// Counts insertions, deletions and replacements (Levenshtein 1966).
std::size_t edit_distance(std::string_view a, std::string_view b);

/// Returns nothing when no name is near.
std::optional<std::string> nearest_name(std::string_view word,
                                        const std::vector<std::string>& known);

/// The names that `word` may mean, best first: those that begin with its words; else those that
/// contain all of them (`blue sapphire` is sapphire_blue); else the nearest by edit distance, whole
/// or in part. Case does not count; `-`, `_` and blanks are equal.
std::vector<std::string> names_like(std::string_view word, const std::vector<std::string>& known);

/// The words must follow one another.
bool holds_whole_words(std::string_view text, std::string_view words);

/// Case does not count; `-`, `_` and blanks are equal.
bool same_words(std::string_view a, std::string_view b);

/// Order and case do not count.
bool holds_words(std::string_view text, std::string_view words);

/// `"a"`, `"a" or "b"`, `"a", "b" or 5 more`: at most `most` quoted names; empty without names.
std::string listed(const std::vector<std::string>& names, std::size_t most = 4);

}  // namespace culet
