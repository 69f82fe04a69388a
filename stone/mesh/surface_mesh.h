#pragma once
// Triangle meshes of any surface, such as settings and stands. For stones, with facets and names,
// see mesh_io.h.

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "stone/solid/solid.h"

namespace culet {

struct TriangleMesh {
    std::vector<Vec3> vertices;
    std::vector<std::array<int, 3>> triangles;  ///< counter-clockwise from outside
    /// Unit normals at each triangle's corners; empty: flat triangles.
    std::vector<std::array<Vec3, 3>> corner_normals;
    /// Of a glTF that culet wrote: the facet that each triangle belongs to; "": none.
    std::vector<std::string> facets;
};

/// True for glTF (.gltf, .glb), whose lengths are metres.
bool is_gltf(const std::filesystem::path& file);

/// Reads OBJ, OFF, PLY, STL or glTF, by the extension. Polygons are cut into triangles, those
/// without area dropped. glTF: all triangles of the scene, placed by its nodes, with its +y as +z.
/// Throws InputError.
TriangleMesh read_triangle_mesh(const std::filesystem::path& file);

/// Gives each corner the mean normal (weighted by angle: Thuermer & Wuethrich 1998) of its vertex's
/// triangles inclined to its own by less than `crease` radians. Vertices at one place count as one.
void smooth_normals(TriangleMesh& mesh, double crease);

/// `file` is for messages, and to find the buffers that it names.
TriangleMesh read_gltf(const std::filesystem::path& file);

}  // namespace culet
