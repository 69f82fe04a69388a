#pragma once
// Any mesh or cut design, with all that its file says.

#include <filesystem>
#include <string>
#include <vector>

#include "stone/gemcad/gemcad_io.h"
#include "stone/stone.h"

namespace culet {

struct SolidInput {
    Solid solid;         ///< with its design, of a cut or a mesh that culet wrote of one
    std::string format;  ///< obj, off, ply, stl, asc, gem
    std::vector<std::string> notes;
    std::vector<std::string> details;  ///< as in ReadCut
    std::vector<std::string> unused_planes, repeated_planes;
    bool facets_are_whole = false;  ///< see Stone
    Vec3 file_up{0, 0, 1};          ///< see Stone
    std::vector<Change> changed;    ///< see Stone
};

/// True for the extensions that `load_solid` reads.
bool is_solid_file(const std::filesystem::path& file);

/// Every command gets its stone here. A mesh whose shape shows that its table faces another way
/// than +z (`table_by_shape`) is turned about the origin until it does, and a note says so; another
/// note says where the size is none of a stone in mm. glTF's metres become mm.
///
/// Throws InputError for an extension that it does not know, naming those that it does, for
/// coordinates beyond 1e50, and for a mesh less than 1e-50 across.
SolidInput load_solid(const std::filesystem::path& file, const CutReading& how = {});

/// Where the width is given besides, a mesh's own size is no question any more: takes what
/// `load_solid` or `read_stone` noted on it (`doubtful_size`) out of `notes`.
void withdraw_size_doubt(const Solid& solid, std::vector<std::string>& notes);

}  // namespace culet
