#pragma once
// Polygon meshes: OBJ, OFF, PLY, STL (ASCII and binary). Faces of one plane are merged into facets.

#include <filesystem>
#include <string>
#include <vector>

#include "stone/solid.h"

namespace culet {

struct ReadSolid {
    Solid solid;
    std::vector<std::string>
        notes;  ///< repairs made on reading, one line each: welded, turned, merged
};

/// Reads by the file's content and extension. Names: see notes/contract ("g" line before a face in
/// OBJ; unnamed facets are f0, f1, ... in file order after faces of one plane are merged; a
/// repeated name gets .1, .2). Throws InputError (with the line where the format has lines) for
/// what cannot be a mesh at all; an open or inverted mesh is returned as it is, for `find_faults`
/// to name.
ReadSolid read_mesh(const std::filesystem::path& file);

/// Writes by extension: .obj .off .ply .stl. Full double precision in text formats. Facet planes
/// ride along in comments of OBJ, OFF and PLY (`culet plane NAME nx ny nz offset`), so that a
/// design with near-miss meets comes back with the planes it had. The file appears whole or not at
/// all.
void write_mesh(const Solid& solid, const std::filesystem::path& file);

}  // namespace culet
