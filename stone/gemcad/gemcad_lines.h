#pragma once
// Lines of GemCad's .asc, in its Windows-1252.

#include <optional>
#include <string>

#include "stone/design/design.h"

namespace culet {

/// A record of a keyword and text; control characters become blanks.
std::string gemcad_line(char keyword, const std::string& text);

/// A name is one word: blanks in it become `_`.
std::string gemcad_word(const std::string& name);

/// All before the first tier, and after the last.
std::string gemcad_head(const Design& design, const std::optional<double>& refractive_index);
std::string gemcad_feet(const Design& design);

}  // namespace culet
