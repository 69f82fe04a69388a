#pragma once
// The faces of a mesh file as the file has them, and how they become a solid.
//
// The formats' readers are our own. OpenMesh's read single precision only, lose the names of facets
// and the line numbers of errors, and refuse the very meshes whose faults we want to name.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "stone/mesh/mesh_io.h"
#include "stone/solid/solid.h"
#include "stone/text/text_scan.h"

namespace culet {

struct SoupFace {
    std::vector<int> corners;
    int name = -1;               ///< index into FaceSoup::names; -1: the file gives no name
    Vec3 given_normal{0, 0, 0};  ///< STL; zero: none
    bool turned = false;         ///< by `orient_faces`
};

struct FaceSoup {
    std::vector<Vec3> vertices;
    std::vector<SoupFace> faces;
    std::vector<std::string> names;
    WrittenPrecision precision;         ///< of the vertices
    WrittenPrecision normal_precision;  ///< of the given normals
    /// From the comments of `write_mesh`, in the order of the faces.
    std::vector<NamedPlane> planes;
    std::optional<std::uint64_t> corner_hash;
    std::string design;  ///< likewise: lines of GemCad's .asc
    std::vector<std::string> notes;
    std::vector<Change> changed;
};

/// Welds coincident vertices, merges faces of one plane, removes corners within straight edges,
/// names the facets and gives them planes. Corner indices must be valid. `notes` list the repairs;
/// the rest is kept as it is.
ReadSolid solid_from_faces(FaceSoup soup);

double size_of(const FaceSoup& soup);

/// Faces of one facet differ by at most this: four times the coordinates' rounding (half a unit in
/// three coordinates, at both the face and the plane), and at least 1e-11 of the size. That is far
/// above the rounding of doubles and still separates facets that differ by 0.05 degrees and are
/// 1e-7 of the size wide.
double merging_tolerance(const FaceSoup& soup, double size);

/// Merges vertices that coincide; if the surface is still open, also those that differ by no more
/// than rounding.
void weld_vertices(FaceSoup& soup);

/// Removes faces with the same corners as an earlier one (in either direction) if each edge has two
/// faces afterwards. Vertices must be welded.
void drop_repeated_faces(FaceSoup& soup);

/// Turns faces round until neighbours run along their edge in opposite directions: in each
/// connected part the minority, and then all if the volume is negative. Changes nothing if an edge
/// has not exactly two faces, or the surface only one side.
void orient_faces(FaceSoup& soup);

/// On open surfaces: makes corners within `tolerance` of an open side of a face corners of that
/// face, if that leaves fewer open sides.
void close_t_junctions(FaceSoup& soup, double tolerance);

/// The outline of each facet: welds and orients the faces, merges those of one plane, removes
/// corners within straight edges.
std::vector<SoupFace> merged_outlines(FaceSoup& soup, double tolerance);

/// The facet of each face, numbered in the order of their first faces.
std::vector<int> facet_of_face(const FaceSoup& soup, double tolerance);

/// Hashes vertices and faces by FNV-1a; tells whether a mesh was edited since culet wrote it.
std::uint64_t corner_hash(const std::vector<Vec3>& vertices,
                          const std::vector<const std::vector<int>*>& outlines);

/// Reads `culet plane NAME nx ny nz offset`, `culet corners HASH` and `culet asc LINE` (the
/// design); ignores other comments. `comment` comes without its comment sign.
void read_comment(FaceSoup& soup, std::string_view comment);

/// The same comments for a solid, one per line after `sign` (`# `, `comment `).
std::string plane_comments(const Solid& solid, std::string_view sign);

/// Turns control characters, and a `#` or `\` that would begin a comment or continue a line, into
/// `_`; removes blanks at the ends.
std::string writable_name(std::string_view name);

/// Makes names unique: repeated ones get .1, .2 ...; empty ones become f0, f1 ... in order,
/// skipping names in use. An unnamed facet whose tier has a name (`of_tier`; empty: none) counts as
/// a repetition of it: A, A.1, A.2, ...
std::vector<std::string> unique_names(std::vector<std::string> names,
                                      const std::vector<std::string>& of_tier = {});

}  // namespace culet
