#pragma once
// Polygon meshes: OBJ, OFF, PLY, STL (ASCII and binary). Faces of one plane are merged into facets.

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "stone/solid/solid.h"
#include "stone/text/change.h"

namespace culet {

enum class MeshFormat { obj, off, ply, stl };

/// By the extension, in small or capital letters.
std::optional<MeshFormat> mesh_format(const std::filesystem::path& file);

struct ReadSolid {
    Solid solid;
    std::vector<std::string> notes;  ///< repairs made on reading, one line each: welded, merged
    std::vector<Change> changed;     ///< of what was given, which notes tell as well
    bool planes_stated = false;      ///< by the comments of `write_mesh`
};

/// Reads a mesh; the format is told by the extension, text or binary by the content.
///
/// Names: in OBJ the `g` line before a face names its facet; unnamed facets are f0, f1, ... in file
/// order after faces of one plane are merged; a repeated name gets .1, .2.
///
/// Faces that share an edge, have the same name (or none) and lie in one plane to within the
/// rounding of the file's coordinates (by their digits, or single precision) become one facet;
/// corners within straight edges go, and vertices that coincide are welded. Planes are those
/// through the corners, unless comments of `write_mesh` state them and the mesh is as it was
/// written.
///
/// Throws InputError (with the line where the format has lines) for what cannot be a mesh at all;
/// an open or inverted mesh is returned as it is, for `find_faults` to name.
ReadSolid read_mesh(const std::filesystem::path& file);

/// The same from memory; `file` is for messages.
ReadSolid parse_mesh(std::string_view bytes, MeshFormat format,
                     const std::filesystem::path& file = "mesh");

/// Writes by extension: .obj .off .ply .stl. Every double reads back as it was. Facet planes ride
/// along in comments of OBJ, OFF and PLY (`culet plane NAME nx ny nz offset`, after `culet corners
/// HASH`), so that a design with near-miss meets comes back with the planes it had; so does the
/// design that the solid was cut by (`culet asc LINE`). In STL (text)
/// each triangle has its facet's normal; offsets, names and design are lost. The file appears whole
/// or not at all.
void write_mesh(const Solid& solid, const std::filesystem::path& file);

/// The same for the mesh of a design, which a comment names: `culet design NAME`. In STL there is
/// no place for it.
void write_design(const Solid& solid, const std::string& design, const std::filesystem::path& file);

/// The same for a surface that is curved, such as a ring: triangles, whose planes are those through
/// their corners, so that none is stated. Neighbours of one name share it.
void write_surface(const Solid& surface, const std::filesystem::path& file);

/// The design whose mesh a file holds: as `write_design` named it, `GemCad` for .asc and .gem;
/// nothing for a drawing, a fitted stone, or a file that cannot be read.
std::optional<std::string> design_of(const std::filesystem::path& file);

/// What `write_mesh` writes.
std::string mesh_text(const Solid& solid, MeshFormat format, bool with_planes = true);

}  // namespace culet
