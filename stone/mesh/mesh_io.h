#pragma once
// Reads and writes polygon meshes: OBJ, OFF, PLY, STL (ASCII and binary). Coplanar faces become
// facets.

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "stone/solid/solid.h"
#include "stone/text/change.h"

namespace culet {

enum class MeshFormat { obj, off, ply, stl };

/// Goes by the extension, in either case.
std::optional<MeshFormat> mesh_format(const std::filesystem::path& file);

struct ReadSolid {
    Solid solid;
    std::vector<std::string> notes;  ///< repairs made on reading (welded, merged), one line each
    std::vector<Change> changed;     ///< what reading changed; notes report it as well
    bool planes_stated = false;      ///< in the comments of `write_mesh`
};

/// The extension tells the format, the content whether it is text or binary.
///
/// Names: in OBJ the `g` line before a face names its facet. Unnamed facets are f0, f1, ... in file
/// order after merging; a repeated name gets .1, .2.
///
/// Faces become one facet if they share an edge, have the same name (or none) and are coplanar
/// within the coordinates' rounding (by their digits, or single precision). Corners within straight
/// edges are removed and coincident vertices welded. Planes pass through the corners, unless
/// comments of `write_mesh` state them and the mesh is unchanged since.
///
/// Throws InputError (with the line where the format has lines) for what cannot be a mesh at all.
/// Open or inverted meshes are returned; see `find_faults`.
ReadSolid read_mesh(const std::filesystem::path& file);

/// The same from memory; `file` is for messages.
ReadSolid parse_mesh(std::string_view bytes, MeshFormat format,
                     const std::filesystem::path& file = "mesh");

/// Writes by extension: .obj .off .ply .stl. Doubles read back exactly. Comments of OBJ, OFF and
/// PLY hold the facets' planes (`culet plane NAME nx ny nz offset`, after `culet corners HASH`), so
/// that a design with near-miss meets keeps them, and the solid's design (`culet asc LINE`). STL
/// (text) has each facet's normal; offsets, names and design are lost. The file appears complete or
/// not at all.
void write_mesh(const Solid& solid, const std::filesystem::path& file);

/// The same for the mesh of a design, named in a comment: `culet design NAME`. STL has no place for
/// it.
void write_design(const Solid& solid, const std::string& design, const std::filesystem::path& file);

/// The same for a curved surface, such as a ring: triangles without stated planes. Neighbours of
/// one name share it.
void write_surface(const Solid& surface, const std::filesystem::path& file);

/// The design whose mesh a file holds: the name in `write_design`'s comment, or `GemCad` for .asc
/// and .gem. Nothing for a drawing, a fitted stone, or an unreadable file.
std::optional<std::string> design_of(const std::filesystem::path& file);

std::string mesh_text(const Solid& solid, MeshFormat format, bool with_planes = true);

}  // namespace culet
