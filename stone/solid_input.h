#pragma once
// Reads any mesh or cut design, with all that its file says.

#include <filesystem>
#include <string>
#include <vector>

#include "stone/gemcad/gemcad_io.h"
#include "stone/stone.h"

namespace culet {

struct SolidInput {
    Solid solid;         ///< with its design, for a cut or for a mesh that culet wrote of one
    std::string format;  ///< obj, off, ply, stl, asc, gem, gcs, ...
    std::vector<std::string> notes;
    std::vector<std::string> details;  ///< as in ReadCut
    std::vector<std::string> unused_planes, repeated_planes;
    bool facets_are_whole = false;  ///< see Stone
    Vec3 file_up{0, 0, 1};          ///< see Stone
    std::vector<Change> changed;    ///< see Stone
};

/// True for the extensions that `load_solid` reads.
bool is_solid_file(const std::filesystem::path& file);

/// Reads a stone for any command. A mesh whose table does not face +z by its shape
/// (`table_by_shape`) is turned about the origin until it does. Notes report the turn, and a size
/// that no stone in mm has. glTF's metres become mm.
///
/// Throws InputError for unknown extensions (listing the known ones), for coordinates beyond 1e50,
/// and for a mesh less than 1e-50 across.
SolidInput load_solid(const std::filesystem::path& file, const CutReading& how = {});

/// As `read_solid` (stone.h), from memory; glTF is not read.
SolidFile solid_of_bytes(const std::string& bytes, const std::filesystem::path& file);

/// Removes the doubts about the mesh's size (`doubtful_size`) from `notes`. For when the width is
/// given separately.
void withdraw_size_doubt(const Solid& solid, std::vector<std::string>& notes);

}  // namespace culet
