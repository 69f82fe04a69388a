#pragma once
// Any mesh or cut design, with all that its file says.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "stone/gemcad_io.h"
#include "stone/solid.h"

namespace culet {

struct SolidInput {
    Solid solid;
    std::string format;  ///< obj, off, ply, stl, asc, gem
    std::vector<std::string> notes;
    std::vector<std::string> details;  ///< as in ReadCut
    std::optional<CutSheet> sheet;     ///< of a cut design
    std::vector<std::string> unused_planes, repeated_planes;
};

/// True for the extensions that `load_solid` reads.
bool is_solid_file(const std::filesystem::path& file);

/// Throws InputError for an extension that it does not know, naming those that it does.
SolidInput load_solid(const std::filesystem::path& file, const CutReading& how = {});

}  // namespace culet
