#pragma once
// `culet info --materials [WORD]`: the catalogue of materials with its colours.

#include <filesystem>
#include <string>

namespace culet {

struct MaterialList {
    std::string words;           ///< only materials that these words name; empty: all
    std::filesystem::path json;  ///< empty: none; `-`: stdout, and nothing else there
    std::filesystem::path page;  ///< HTML; empty: none
};

/// Prints the list, writes what was asked for. Throws InputError when no material is named so.
void list_materials(const MaterialList& list);

}  // namespace culet
