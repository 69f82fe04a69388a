#include "stone/mesh/surface_mesh.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <tuple>

#include "stone/mesh/mesh_formats.h"
#include "stone/solid/facet_triangles.h"
#include "stone/text/errors.h"
#include "stone/text/output_file.h"
#include "stone/text/text_scan.h"

namespace culet {

namespace {

TriangleMesh triangles_of(FaceSoup soup) {
    TriangleMesh mesh;
    Solid faces;
    faces.vertices = std::move(soup.vertices);
    for (SoupFace& face : soup.faces) {
        if (face.corners.size() < 3) continue;
        std::vector<Vec3> loop;
        for (const int corner : face.corners)
            loop.push_back(faces.vertices[static_cast<std::size_t>(corner)]);
        const Facet facet{"", plane_through(loop), std::move(face.corners)};
        for (const auto& triangle : facet_triangles(faces, facet))
            mesh.triangles.push_back(triangle);
    }
    mesh.vertices = std::move(faces.vertices);
    return mesh;
}

Vec3 area_vector(const TriangleMesh& mesh, const std::array<int, 3>& t) {
    const auto at = [&](int k) { return mesh.vertices[static_cast<std::size_t>(t[k])]; };
    return glm::cross(at(1) - at(0), at(2) - at(0));
}

}  // namespace

bool is_gltf(const std::filesystem::path& file) {
    const std::string extension = extension_of(file);
    return extension == "gltf" || extension == "glb";
}

TriangleMesh read_triangle_mesh(const std::filesystem::path& file) {
    TriangleMesh mesh;
    if (is_gltf(file)) {
        mesh = read_gltf(file);
    } else {
        const auto format = mesh_format(file);
        if (!format) {
            throw InputError(
                file,
                "is of an unknown kind: a mesh ends in .obj, .off, .ply, .stl, .gltf or .glb");
        }
        const std::string bytes = read_text(file);
        if (bytes.empty()) throw InputError(file, "is empty");
        mesh = triangles_of(soup_of(bytes, *format, file));
    }
    mesh.facets.resize(mesh.triangles.size());
    std::size_t kept = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        if (!(glm::length(area_vector(mesh, mesh.triangles[t])) > 0)) continue;
        mesh.triangles[kept] = mesh.triangles[t];
        mesh.facets[kept++].swap(mesh.facets[t]);
    }
    mesh.triangles.resize(kept);
    mesh.facets.resize(kept);
    if (mesh.triangles.empty()) throw InputError(file, "holds no triangle");
    return mesh;
}

void smooth_normals(TriangleMesh& mesh, double crease) {
    std::map<std::tuple<double, double, double>, std::vector<std::size_t>> around;
    std::vector<Vec3> unit;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        unit.push_back(glm::normalize(area_vector(mesh, mesh.triangles[i])));
        for (const int corner : mesh.triangles[i]) {
            const Vec3& v = mesh.vertices[static_cast<std::size_t>(corner)];
            around[{v.x, v.y, v.z}].push_back(i);
        }
    }
    const auto angle_at = [&](std::size_t triangle, const Vec3& vertex) {
        const std::array<int, 3>& t = mesh.triangles[triangle];
        for (std::size_t k = 0; k < 3; ++k) {
            const auto at = [&](std::size_t j) {
                return mesh.vertices[static_cast<std::size_t>(t[(k + j) % 3])];
            };
            if (at(0) == vertex) return angle_between(at(1) - at(0), at(2) - at(0));
        }
        return 0.0;
    };
    const double least_cosine = std::cos(crease);
    mesh.corner_normals.assign(mesh.triangles.size(), {});
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3& v = mesh.vertices[static_cast<std::size_t>(mesh.triangles[i][k])];
            Vec3 sum(0);
            for (const std::size_t other : around[{v.x, v.y, v.z}]) {
                if (other == i || glm::dot(unit[other], unit[i]) > least_cosine)
                    sum += angle_at(other, v) * unit[other];
            }
            const double length = glm::length(sum);
            mesh.corner_normals[i][k] = length > 0 ? sum / length : unit[i];
        }
    }
}

}  // namespace culet
