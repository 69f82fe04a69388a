#pragma once
// The faces of a mesh file as they stand there, and how they become a solid.
//
// The readers of the formats are our own: OpenMesh's read single precision only, lose the names
// of facets and the lines of errors, and refuse the very meshes whose faults we want to name.

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
    int name = -1;               ///< index into FaceSoup::names; -1: the file gives none
    Vec3 given_normal{0, 0, 0};  ///< STL; zero: none
    bool turned = false;         ///< by `orient_faces`
};

struct FaceSoup {
    std::vector<Vec3> vertices;
    std::vector<SoupFace> faces;
    std::vector<std::string> names;
    WrittenPrecision precision;         ///< of the vertices
    WrittenPrecision normal_precision;  ///< of the given normals
    /// From the comments that `write_mesh` leaves, in the order of the faces.
    std::vector<NamedPlane> planes;
    std::optional<std::uint64_t> corner_hash;
    std::string design;  ///< likewise: lines of GemCad's .asc
    std::vector<std::string> notes;
    std::vector<Change> changed;
};

/// Welds vertices that coincide, merges faces of one plane, drops corners within straight edges,
/// names the facets and gives them planes. Corner indices must be valid. Says in `notes` what it
/// repaired; what cannot be repaired stays as it is.
ReadSolid solid_from_faces(FaceSoup soup);

/// The diameter of the vertices.
double size_of(const FaceSoup& soup);

/// Two faces of a facet come apart by this much and no more: four times the rounding of the
/// coordinates (half a unit in three coordinates, at both the face and the plane), and never less
/// than 1e-11 of the size, which is far above the rounding of doubles and still tells facets that
/// differ by 0.05 degrees apart when they are 1e-7 of the size wide.
double merging_tolerance(const FaceSoup& soup, double size);

/// Puts one vertex in the place of those that coincide, first exactly, then, if the surface is open
/// still, of those no further apart than rounding explains.
void weld_vertices(FaceSoup& soup);

/// Leaves out faces with the same corners as an earlier one, run round either way, where each edge
/// has two faces then. For welded vertices.
void drop_repeated_faces(FaceSoup& soup);

/// Turns faces round until neighbours run along their edge in opposite ways, of each connected part
/// the fewer, and all of them where the volume is negative then. A surface that has an edge of one
/// face or of more than two, or one side only, is left as it is.
void orient_faces(FaceSoup& soup);

/// Where a surface is open, corners that lie within `tolerance` of the side of a face that has none
/// there become corners of that face, if that leaves fewer open sides.
void close_t_junctions(FaceSoup& soup, double tolerance);

/// For each face the facet that it is part of, numbered in the order of their first faces.
std::vector<int> facet_of_face(const FaceSoup& soup, double tolerance);

/// FNV-1a of the vertices' bits and the faces' corners: tells a mesh that is as culet wrote it from
/// one that was edited since.
std::uint64_t corner_hash(const std::vector<Vec3>& vertices,
                          const std::vector<const std::vector<int>*>& outlines);

/// Reads `culet plane NAME nx ny nz offset`, `culet corners HASH` and `culet asc LINE` of the
/// design; other comments are passed over. `comment` comes without its comment sign.
void read_comment(FaceSoup& soup, std::string_view comment);

/// Those comments for a solid, one a line, each begun by `sign` (`# `, `comment `).
std::string plane_comments(const Solid& solid, std::string_view sign);

/// A facet's name as it can stand in a file: control characters, and a `#` or `\` that would begin
/// a comment or continue a line, become `_`; blanks at the ends go.
std::string writable_name(std::string_view name);

/// `names` with later repetitions told apart by .1, .2 ...; empty ones become f0, f1 ... in order,
/// passing over names that are taken. A facet without a name of its own that belongs to a tier with
/// one (`of_tier`, for each facet; empty: none) is a further repetition of that: A, A.1, A.2, ...
std::vector<std::string> told_apart(std::vector<std::string> names,
                                    const std::vector<std::string>& of_tier = {});

}  // namespace culet
