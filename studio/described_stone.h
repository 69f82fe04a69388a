#pragma once
// A stone in words: "9 x 7 oval, blue sapphire", "6,5 mm brilliant, table 57", "2 ct emerald cut".

#include <map>
#include <string>
#include <vector>

namespace culet {

struct DescribedStone {
    std::string kind;                      ///< of `cut_kinds`; round-brilliant if none is named
    std::map<std::string, double> values;  ///< of its parameters, as far as they are named
    std::string material;                  ///< of the catalogue; empty: none named
    std::vector<std::string> notes;        ///< what was taken for granted, or not understood
};

/// Sizes in mm, length by width; a decimal comma is taken. A weight (ct) needs a material. Throws
/// InputError for text of more than 200 characters, and where nothing was understood.
DescribedStone described_stone(const std::string& text);

}  // namespace culet
