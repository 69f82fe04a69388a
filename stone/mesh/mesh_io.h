#pragma once
// Reads and writes polygon meshes: OBJ, OFF, PLY, STL (ASCII and binary). Faces of one plane are
// merged into facets.

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "stone/solid/solid.h"
#include "stone/text/change.h"

namespace culet {

enum class MeshFormat { obj, off, ply, stl };

/// By the extension, in either case.
std::optional<MeshFormat> mesh_format(const std::filesystem::path& file);

struct ReadSolid {
    Solid solid;
    std::vector<std::string> notes;  ///< repairs made on reading (welded, merged), one line each
    std::vector<Change> changed;     ///< what reading changed; notes report it as well
    bool planes_stated = false;      ///< in the comments of `write_mesh`
};

/// Reads a mesh. The extension tells the format, the content whether it is text or binary.
///
/// Names: in OBJ the `g` line before a face names its facet. Unnamed facets are f0, f1, ... in file
/// order after merging; a repeated name gets .1, .2.
///
/// Faces become one facet if they share an edge, have the same name (or none) and lie in one plane
/// within the rounding of the file's coordinates (by their digits, or single precision). Corners
/// within straight edges are removed and coincident vertices welded. Planes are those through the
/// corners, unless the comments of `write_mesh` state them and the mesh is unchanged since.
///
/// Throws InputError (with the line where the format has lines) for what cannot be a mesh at all.
/// An open or inverted mesh is returned as it is; `find_faults` names its faults.
ReadSolid read_mesh(const std::filesystem::path& file);

/// The same from memory; `file` is for messages.
ReadSolid parse_mesh(std::string_view bytes, MeshFormat format,
                     const std::filesystem::path& file = "mesh");

/// Writes by extension: .obj .off .ply .stl. Every double reads back exactly. Comments of OBJ, OFF
/// and PLY hold the facets' planes (`culet plane NAME nx ny nz offset`, after `culet corners
/// HASH`), so that a design with near-miss meets keeps its planes, and the design that the solid
/// was cut by (`culet asc LINE`). In STL (text) each triangle has its facet's normal; offsets,
/// names and design are lost. The file appears complete or not at all.
void write_mesh(const Solid& solid, const std::filesystem::path& file);

/// The same for the mesh of a design, named in a comment: `culet design NAME`. STL has no place for
/// it.
void write_design(const Solid& solid, const std::string& design, const std::filesystem::path& file);

/// The same for a curved surface, such as a ring: triangles with the planes through their corners,
/// so no plane is stated. Neighbours of one name share it.
void write_surface(const Solid& surface, const std::filesystem::path& file);

/// The design whose mesh a file holds: the name that `write_design` wrote, or `GemCad` for .asc and
/// .gem. Nothing for a drawing, a fitted stone, or a file that cannot be read.
std::optional<std::string> design_of(const std::filesystem::path& file);

/// The text that `write_mesh` writes.
std::string mesh_text(const Solid& solid, MeshFormat format, bool with_planes = true);

}  // namespace culet
