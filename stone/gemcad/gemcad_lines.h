#pragma once
// Lines of GemCad's .asc, in Windows-1252 as GemCad writes them.

#include <optional>
#include <string>

#include "stone/design/design.h"

namespace culet {

/// A record: keyword and text. Control characters become blanks.
std::string gemcad_line(char keyword, const std::string& text);

/// A name as one word: blanks become `_`.
std::string gemcad_word(const std::string& name);

/// Everything before the first tier, and everything after the last.
std::string gemcad_head(const Design& design, const std::optional<double>& refractive_index);
std::string gemcad_feet(const Design& design);

}  // namespace culet
