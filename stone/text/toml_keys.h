#pragma once
// How deep the keys of a TOML text go, told before it is parsed.

#include <cstddef>
#include <string_view>

namespace culet {

/// The line (from 1) of the first key, or name of a table, with more than `most` parts between
/// dots; 0: none. Strings and comments are passed over; numbers count their dots, too, which does
/// no harm. Of a text that is no TOML: some line or none.
long line_of_deep_key(std::string_view text, std::size_t most);

}  // namespace culet
