#pragma once
// `culet info --materials [WORD]`: the catalogue of materials with its colours.

#include <filesystem>
#include <string>

namespace culet {

struct MaterialList {
    std::string words;           ///< only materials that match these words; empty: all
    std::filesystem::path json;  ///< empty: none; `-`: stdout, which then gets nothing else
    std::filesystem::path page;  ///< HTML; empty: none
};

/// Prints the list and writes the files. Throws InputError when no material matches.
void list_materials(const MaterialList& list);

}  // namespace culet
