// glTF 2.0, through tinygltf.

#include <fmt/format.h>
#include <tiny_gltf.h>

#include <cstring>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/matrix.hpp>
#include <optional>

#include "stone/errors.h"
#include "stone/output_file.h"
#include "stone/surface_mesh.h"

namespace culet {

namespace {

constexpr int k_deepest_node = 64;
// A mesh may be placed many times: what a hostile file of a few lines may grow to.
constexpr std::size_t k_most_triangles = 50'000'000;

class Reader {
public:
    Reader(const tinygltf::Model& model, const std::filesystem::path& file)
        : model_(model), file_(file) {}

    TriangleMesh scene() {
        if (model_.scenes.empty()) {
            for (std::size_t i = 0; i < model_.meshes.size(); ++i)
                place(static_cast<int>(i), glm::dmat4(1.0));
        } else {
            const int chosen = model_.defaultScene >= 0 ? model_.defaultScene : 0;
            for (const int node : entry(model_.scenes, chosen, "scene").nodes)
                walk(node, glm::dmat4(1.0), 0);
        }
        // +y of glTF is up, as +z is here.
        for (Vec3& v : mesh_.vertices) v = {v.x, -v.z, v.y};
        return std::move(mesh_);
    }

private:
    template <class T>
    const T& entry(const std::vector<T>& list, int index, const char* what) const {
        if (index < 0 || static_cast<std::size_t>(index) >= list.size())
            throw InputError(file_, fmt::format("names {} {}, which is not there", what, index));
        return list[static_cast<std::size_t>(index)];
    }

    void walk(int index, const glm::dmat4& above, int depth) {
        if (depth > k_deepest_node)
            throw InputError(file_, fmt::format("its nodes are nested over {} deep, or in a circle",
                                                k_deepest_node));
        const tinygltf::Node& node = entry(model_.nodes, index, "node");
        const glm::dmat4 here = above * matrix_of(node);
        if (node.mesh >= 0) place(node.mesh, here);
        for (const int child : node.children) walk(child, here, depth + 1);
    }

    static glm::dmat4 matrix_of(const tinygltf::Node& node) {
        if (node.matrix.size() == 16) return glm::make_mat4(node.matrix.data());
        glm::dmat4 matrix(1.0);
        if (node.translation.size() == 3)
            matrix[3] = {node.translation[0], node.translation[1], node.translation[2], 1};
        if (node.rotation.size() == 4) {
            const glm::dquat turn(node.rotation[3], node.rotation[0], node.rotation[1],
                                  node.rotation[2]);
            matrix = matrix * glm::mat4_cast(turn);
        }
        if (node.scale.size() == 3) {
            glm::dmat4 scale(1.0);
            for (int k = 0; k < 3; ++k) scale[k][k] = node.scale[static_cast<std::size_t>(k)];
            matrix = matrix * scale;
        }
        return matrix;
    }

    void place(int index, const glm::dmat4& matrix) {
        const bool mirrored = glm::determinant(glm::dmat3(matrix)) < 0;
        for (const tinygltf::Primitive& primitive :
             entry(model_.meshes, index, "mesh").primitives) {
            if (primitive.mode != TINYGLTF_MODE_TRIANGLES && primitive.mode != -1) continue;
            const auto position = primitive.attributes.find("POSITION");
            if (position == primitive.attributes.end()) continue;
            const int first = static_cast<int>(mesh_.vertices.size());
            const int count = add_vertices(position->second, matrix);
            for (const std::array<int, 3>& t : triangles_of(primitive, count)) {
                std::array<int, 3> placed{first + t[0], first + t[1], first + t[2]};
                if (mirrored) std::swap(placed[1], placed[2]);
                mesh_.triangles.push_back(placed);
            }
            if (mesh_.triangles.size() > k_most_triangles)
                throw InputError(file_, fmt::format("has over {} triangles", k_most_triangles));
        }
    }

    // The bytes of element i of an accessor, all of which lie in its buffer.
    struct Elements {
        const unsigned char* first = nullptr;
        std::size_t stride = 0, count = 0;
    };
    Elements elements(const tinygltf::Accessor& accessor, std::size_t size) const {
        const tinygltf::BufferView& view =
            entry(model_.bufferViews, accessor.bufferView, "buffer view");
        const tinygltf::Buffer& buffer = entry(model_.buffers, view.buffer, "buffer");
        const int stride = accessor.ByteStride(view);
        const std::size_t bytes = buffer.data.size();
        if (stride <= 0 || view.byteOffset > bytes || view.byteLength > bytes - view.byteOffset ||
            accessor.byteOffset > view.byteLength ||
            (accessor.count > 0 &&
             (size > view.byteLength - accessor.byteOffset ||
              (accessor.count - 1) > (view.byteLength - accessor.byteOffset - size) /
                                         static_cast<std::size_t>(stride)))) {
            throw InputError(file_, "is damaged: an accessor reaches beyond its buffer");
        }
        if (accessor.sparse.isSparse) throw InputError(file_, "has sparse accessors: not read");
        return {buffer.data.data() + view.byteOffset + accessor.byteOffset,
                static_cast<std::size_t>(stride), accessor.count};
    }

    int add_vertices(int index, const glm::dmat4& matrix) {
        const tinygltf::Accessor& accessor = entry(model_.accessors, index, "accessor");
        if (accessor.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT ||
            accessor.type != TINYGLTF_TYPE_VEC3)
            throw InputError(file_, "has positions that are not three floats");
        const Elements from = elements(accessor, 3 * sizeof(float));
        if (mesh_.vertices.size() + from.count > 3 * k_most_triangles)
            throw InputError(file_, "has too many vertices");
        for (std::size_t i = 0; i < from.count; ++i) {
            std::array<float, 3> p{};
            std::memcpy(p.data(), from.first + i * from.stride, sizeof p);
            const glm::dvec4 placed = matrix * glm::dvec4(p[0], p[1], p[2], 1);
            if (!std::isfinite(placed.x + placed.y + placed.z))
                throw InputError(file_, "has a vertex that is no number");
            mesh_.vertices.emplace_back(placed.x, placed.y, placed.z);
        }
        return static_cast<int>(from.count);
    }

    std::vector<std::array<int, 3>> triangles_of(const tinygltf::Primitive& primitive,
                                                 int vertices) const {
        std::vector<int> corners;
        if (primitive.indices < 0) {
            for (int i = 0; i < vertices; ++i) corners.push_back(i);
        } else {
            const tinygltf::Accessor& accessor =
                entry(model_.accessors, primitive.indices, "accessor");
            const std::size_t size = index_size(accessor.componentType);
            const Elements from = elements(accessor, size);
            for (std::size_t i = 0; i < from.count; ++i) {
                // Little-endian, as the file and the machine are.
                std::uint32_t corner = 0;
                std::memcpy(&corner, from.first + i * from.stride, size);
                if (corner >= static_cast<std::uint32_t>(vertices))
                    throw InputError(
                        file_, fmt::format("a triangle names vertex {} of {}", corner, vertices));
                corners.push_back(static_cast<int>(corner));
            }
        }
        std::vector<std::array<int, 3>> triangles;
        for (std::size_t i = 0; i + 2 < corners.size(); i += 3)
            triangles.push_back({corners[i], corners[i + 1], corners[i + 2]});
        return triangles;
    }

    std::size_t index_size(int type) const {
        switch (type) {
            case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
                return 1;
            case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
                return 2;
            case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
                return 4;
            default:
                throw InputError(file_, "has indices of an unknown type");
        }
    }

    const tinygltf::Model& model_;
    const std::filesystem::path& file_;
    TriangleMesh mesh_;
};

// Pictures on a surface are not drawn.
bool pass_over_image(tinygltf::Image*, const int, std::string*, std::string*, int, int,
                     const unsigned char*, int, void*) {
    return true;
}

}  // namespace

TriangleMesh read_gltf(const std::filesystem::path& file) {
    const std::string bytes = read_text(file);
    if (bytes.size() > std::numeric_limits<unsigned>::max()) throw InputError(file, "is too large");
    tinygltf::TinyGLTF loader;
    loader.SetImageLoader(pass_over_image, nullptr);
    tinygltf::Model model;
    std::string error, warning;
    const auto size = static_cast<unsigned>(bytes.size());
    const bool binary = bytes.compare(0, 4, "glTF") == 0;
    const std::string folder = file.parent_path().string();
    const bool read =
        binary ? loader.LoadBinaryFromMemory(&model, &error, &warning,
                                             reinterpret_cast<const unsigned char*>(bytes.data()),
                                             size, folder)
               : loader.LoadASCIIFromString(&model, &error, &warning, bytes.data(), size, folder);
    if (!read) {
        // The first line of what tinygltf says; it may quote the file.
        throw InputError(file, "is no glTF that can be read: " + error.substr(0, error.find('\n')));
    }
    return Reader(model, file).scene();
}

}  // namespace culet
