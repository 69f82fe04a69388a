#pragma once
// What somebody may have meant who wrote a name that is not known.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace culet {

/// Levenshtein (1966): fewest insertions, deletions and replacements from one word to the other.
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The name among `known` that is nearest to `word` by edit distance, or nothing when none is near.
std::optional<std::string> nearest_name(std::string_view word,
                                        const std::vector<std::string>& known);

/// Those of `known` that somebody who wrote `word` may have meant, best first: they begin with its
/// words, else hold all of them (`blue sapphire` is sapphire_blue), else are nearest by edit
/// distance, whole or in one part of the name. Letters of either case, `-`, `_` and blanks are the
/// same. Empty when none is near.
std::vector<std::string> names_like(std::string_view word, const std::vector<std::string>& known);

/// True when `text` holds these words one after another, each whole.
bool holds_whole_words(std::string_view text, std::string_view words);

/// True when both are the same words: letters of either case, `-`, `_` and blanks are the same.
bool same_words(std::string_view a, std::string_view b);

/// True when `text` holds every word of `words`; letters of either case are the same.
bool holds_words(std::string_view text, std::string_view words);

/// `"a"`, `"a" or "b"`, `"a", "b" or 5 more`: at most `most` names in quotes; empty without names.
std::string listed(const std::vector<std::string>& names, std::size_t most = 4);

}  // namespace culet
