#pragma once
// Checks the nesting of a TOML text's keys before it is parsed.

#include <cstddef>
#include <string_view>

namespace culet {

/// The line (from 1) of the first key, or table name, with more than `most` parts between dots; 0:
/// none. Skips strings and comments; also counts the dots of numbers, which is harmless. Arbitrary
/// for text that is not TOML.
long line_of_deep_key(std::string_view text, std::size_t most);

}  // namespace culet
