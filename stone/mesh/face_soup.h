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
    /// From the comments that `write_mesh` writes, in the order of the faces.
    std::vector<NamedPlane> planes;
    std::optional<std::uint64_t> corner_hash;
    std::string design;  ///< from those comments, too: lines of GemCad's .asc
    std::vector<std::string> notes;
    std::vector<Change> changed;
};

/// Welds coincident vertices, merges faces of one plane, removes corners within straight edges,
/// names the facets and gives them planes. Corner indices must be valid. `notes` list the repairs;
/// what cannot be repaired is kept.
ReadSolid solid_from_faces(FaceSoup soup);

/// The diameter of the vertices.
double size_of(const FaceSoup& soup);

/// Two faces of one facet differ by at most this: four times the coordinates' rounding (half a unit
/// in three coordinates, at both the face and the plane), and at least 1e-11 of the size. That is
/// far above the rounding of doubles and still separates facets that differ by 0.05 degrees when
/// they are 1e-7 of the size wide.
double merging_tolerance(const FaceSoup& soup, double size);

/// Merges vertices that coincide exactly. If the surface is still open, merges those that are no
/// further apart than rounding explains.
void weld_vertices(FaceSoup& soup);

/// Removes faces that have the same corners as an earlier face (in either direction), if each edge
/// has two faces afterwards. Vertices must be welded.
void drop_repeated_faces(FaceSoup& soup);

/// Turns faces round until neighbours run along their edge in opposite directions: in each
/// connected part the minority, and all of them if the volume is negative then. Leaves a surface
/// alone that has an edge without exactly two faces, or only one side.
void orient_faces(FaceSoup& soup);

/// Where a surface is open: corners within `tolerance` of the side of a face that has none there
/// become corners of that face, if that leaves fewer open sides.
void close_t_junctions(FaceSoup& soup, double tolerance);

/// The facet of each face, numbered in the order of their first faces.
std::vector<int> facet_of_face(const FaceSoup& soup, double tolerance);

/// FNV-1a of the vertices' bits and the faces' corners. Tells whether a mesh was edited since culet
/// wrote it.
std::uint64_t corner_hash(const std::vector<Vec3>& vertices,
                          const std::vector<const std::vector<int>*>& outlines);

/// Reads `culet plane NAME nx ny nz offset`, `culet corners HASH` and `culet asc LINE` (the
/// design); ignores other comments. `comment` comes without its comment sign.
void read_comment(FaceSoup& soup, std::string_view comment);

/// The same comments for a solid, one per line, each begun by `sign` (`# `, `comment `).
std::string plane_comments(const Solid& solid, std::string_view sign);

/// A facet's name as a file can hold it. Control characters, and a `#` or `\` that would begin a
/// comment or continue a line, become `_`; blanks at the ends are removed.
std::string writable_name(std::string_view name);

/// Makes `names` unique: repeated ones get .1, .2 ...; empty ones become f0, f1 ... in order,
/// skipping names in use. A facet without a name whose tier has one (`of_tier`, for each facet;
/// empty: none) counts as a repetition of that: A, A.1, A.2, ...
std::vector<std::string> told_apart(std::vector<std::string> names,
                                    const std::vector<std::string>& of_tier = {});

}  // namespace culet
