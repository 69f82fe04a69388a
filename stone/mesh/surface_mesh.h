#pragma once
// Meshes of any surface, as triangles: settings, stands, whatever stands around a stone. Meshes of
// stones, with facets and names, are mesh_io.h's.

#include <array>
#include <filesystem>
#include <vector>

#include "stone/solid/solid.h"

namespace culet {

struct TriangleMesh {
    std::vector<Vec3> vertices;
    std::vector<std::array<int, 3>> triangles;  ///< counter-clockwise from outside
    /// Unit normals of each triangle's corners; none: it is flat.
    std::vector<std::array<Vec3, 3>> corner_normals;
};

/// True for glTF (.gltf, .glb), whose lengths are metres.
bool is_gltf(const std::filesystem::path& file);

/// OBJ, OFF, PLY, STL or glTF, by the extension. Polygons are cut into triangles; triangles without
/// area are left out. glTF: all triangles of the scene, placed by its nodes, turned so that its +y
/// is +z. Throws InputError.
TriangleMesh read_triangle_mesh(const std::filesystem::path& file);

/// Gives corners the mean of the normals (weighted by angle: Thuermer & Wuethrich 1998) of the
/// triangles around their vertex that are inclined to their own by less than `crease` radians.
/// Vertices at one place are one vertex.
void smooth_normals(TriangleMesh& mesh, double crease);

/// Reader of one format; `file` is for messages, and for the buffers that it names.
TriangleMesh read_gltf(const std::filesystem::path& file);

}  // namespace culet
