// Reads glTF 2.0, by tinygltf.

#include <fmt/format.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <nlohmann/json.hpp>
#include <type_traits>

#include "stone/mesh/surface_mesh.h"
#include "stone/text/errors.h"
#include "stone/text/output_file.h"
#include "stone/text/text_scan.h"

namespace culet {

namespace {

constexpr int k_deepest_node = 64;
// A hostile file of a few lines may place a mesh many times.
constexpr std::size_t k_most_triangles = 50'000'000;
// For accessors that take no room in the file.
constexpr std::size_t k_most_zeros = 1'000'000;

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
        // glTF's up is +y; ours is +z.
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
        if (node.skin >= 0 && node.mesh >= 0)
            throw InputError(file_, "has a mesh with a skeleton, which is not read");
        if (node.mesh >= 0) {
            for (const glm::dmat4& instance : instances_of(node)) place(node.mesh, here * instance);
        }
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
        const tinygltf::Mesh& mesh = entry(model_.meshes, index, "mesh");
        for (const double weight : mesh.weights) {
            if (weight != 0)
                throw InputError(file_, "has a mesh with morph targets, which are not read");
        }
        const std::size_t before = mesh_.triangles.size();
        for (const tinygltf::Primitive& primitive : mesh.primitives) {
            if (primitive.mode >= 0 && primitive.mode < TINYGLTF_MODE_TRIANGLES)
                continue;  // points and lines
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
        mesh_.facets.resize(mesh_.triangles.size());
        name_facets(mesh.extras, before);
    }

    // By what gltf_bytes (stone/export/gltf_write.h) writes beside the triangles.
    void name_facets(const tinygltf::Value& extras, std::size_t before) {
        const tinygltf::Value list = extras.Get("facets");
        for (std::size_t i = 0; list.IsArray() && i < list.ArrayLen(); ++i) {
            const tinygltf::Value& facet = list.Get(int(i));
            if (!facet.Has("name") || !facet.Get("name").IsString()) continue;
            const int first = facet.Get("first_triangle").GetNumberAsInt(),
                      count = facet.Get("triangles").GetNumberAsInt();
            const std::size_t here = mesh_.facets.size() - before;
            for (int t = std::max(first, 0); t - first < count && std::size_t(t) < here; ++t)
                mesh_.facets[before + std::size_t(t)] = facet.Get("name").Get<std::string>();
        }
    }

    // EXT_mesh_gpu_instancing: one placement per element of its accessors.
    std::vector<glm::dmat4> instances_of(const tinygltf::Node& node) const {
        const auto extension = node.extensions.find("EXT_mesh_gpu_instancing");
        if (extension == node.extensions.end()) return {glm::dmat4(1.0)};
        const tinygltf::Value attributes = extension->second.Get("attributes");
        const auto read = [&](const char* name, int components) {
            return attributes.Has(name) ? numbers(attributes.Get(name).GetNumberAsInt(), components)
                                        : std::vector<double>();
        };
        const std::vector<double> shift = read("TRANSLATION", 3), turn = read("ROTATION", 4),
                                  scale = read("SCALE", 3);
        const std::size_t count = std::max({shift.size() / 3, turn.size() / 4, scale.size() / 3});
        std::vector<glm::dmat4> placed;
        for (std::size_t i = 0; i < count; ++i) {
            tinygltf::Node one;
            const auto part = [i](const std::vector<double>& all, std::size_t n) {
                if (all.size() < (i + 1) * n) return std::vector<double>();
                const auto from = all.begin() + static_cast<std::ptrdiff_t>(i * n);
                return std::vector<double>(from, from + static_cast<std::ptrdiff_t>(n));
            };
            one.translation = part(shift, 3);
            one.rotation = part(turn, 4);
            one.scale = part(scale, 3);
            placed.push_back(matrix_of(one));
        }
        return placed;
    }

    // `size` bytes per element; all elements lie in the buffer.
    struct Elements {
        const unsigned char* first = nullptr;
        std::size_t stride = 0;
    };
    Elements elements(int buffer_view, std::size_t offset, std::size_t stride, std::size_t size,
                      std::size_t count) const {
        const tinygltf::BufferView& view = entry(model_.bufferViews, buffer_view, "buffer view");
        const tinygltf::Buffer& buffer = entry(model_.buffers, view.buffer, "buffer");
        const std::size_t bytes = buffer.data.size();
        if (stride == 0 || view.byteOffset > bytes || view.byteLength > bytes - view.byteOffset ||
            offset > view.byteLength ||
            (count > 0 && (size > view.byteLength - offset ||
                           count - 1 > (view.byteLength - offset - size) / stride))) {
            throw InputError(file_, "is damaged: an accessor reaches beyond its buffer");
        }
        return {buffer.data.data() + view.byteOffset + offset, stride};
    }

    // Normalized integers stand for 0 .. 1 or -1 .. 1 (specification, 3.6.2.2). File and machine
    // are little-endian.
    template <class T>
    static double as(const unsigned char* raw, bool normalized) {
        T value;
        std::memcpy(&value, raw, sizeof value);
        const auto number = static_cast<double>(value);
        if constexpr (std::is_floating_point_v<T>) return number;
        return normalized
                   ? std::max(number / static_cast<double>(std::numeric_limits<T>::max()), -1.0)
                   : number;
    }
    double number_at(const unsigned char* raw, int type, bool normalized) const {
        switch (type) {
            case TINYGLTF_COMPONENT_TYPE_BYTE:
                return as<std::int8_t>(raw, normalized);
            case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
                return as<std::uint8_t>(raw, normalized);
            case TINYGLTF_COMPONENT_TYPE_SHORT:
                return as<std::int16_t>(raw, normalized);
            case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
                return as<std::uint16_t>(raw, normalized);
            case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
                return as<std::uint32_t>(raw, normalized);
            case TINYGLTF_COMPONENT_TYPE_FLOAT:
                return as<float>(raw, normalized);
            default:
                throw InputError(file_, "has an accessor whose numbers are of an unknown type");
        }
    }
    std::size_t size_of(int type) const {
        const int size = tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(type));
        if (size <= 0)
            throw InputError(file_, "has an accessor whose numbers are of an unknown type");
        return static_cast<std::size_t>(size);
    }

    // `components` per element: from the buffer view, or zeros, with the replacements of the sparse
    // part (specification, 3.6.2.3).
    std::vector<double> numbers(int index, int components) const {
        const tinygltf::Accessor& accessor = entry(model_.accessors, index, "accessor");
        if (tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type)) !=
            components)
            throw InputError(
                file_, fmt::format("has an accessor that is not of {} numbers each", components));
        const auto each = static_cast<std::size_t>(components);
        const std::size_t size = size_of(accessor.componentType);
        if (accessor.count > (accessor.bufferView < 0 ? k_most_zeros : 3 * k_most_triangles))
            throw InputError(file_, "has too many vertices");
        std::vector<double> values(accessor.count * each);
        const auto copy = [&](const Elements& from, std::size_t i, std::size_t to) {
            for (std::size_t k = 0; k < each; ++k)
                values[to * each + k] = number_at(from.first + i * from.stride + k * size,
                                                  accessor.componentType, accessor.normalized);
        };
        if (accessor.bufferView >= 0) {
            const int stride =
                accessor.ByteStride(entry(model_.bufferViews, accessor.bufferView, "buffer view"));
            const Elements from = elements(accessor.bufferView, accessor.byteOffset,
                                           static_cast<std::size_t>(std::max(stride, 0)),
                                           each * size, accessor.count);
            for (std::size_t i = 0; i < accessor.count; ++i) copy(from, i, i);
        }
        if (!accessor.sparse.isSparse) return values;
        const auto& sparse = accessor.sparse;
        const auto count = static_cast<std::size_t>(std::max(sparse.count, 0));
        const std::size_t index_size = size_of(sparse.indices.componentType);
        const Elements places =
            elements(sparse.indices.bufferView, static_cast<std::size_t>(sparse.indices.byteOffset),
                     index_size, index_size, count);
        const Elements from =
            elements(sparse.values.bufferView, static_cast<std::size_t>(sparse.values.byteOffset),
                     each * size, each * size, count);
        for (std::size_t i = 0; i < count; ++i) {
            const double place =
                number_at(places.first + i * places.stride, sparse.indices.componentType, false);
            if (!(place < static_cast<double>(accessor.count)) || !(place >= 0))
                throw InputError(file_, "is damaged: a sparse accessor replaces what is not there");
            copy(from, i, static_cast<std::size_t>(place));
        }
        return values;
    }

    int add_vertices(int index, const glm::dmat4& matrix) {
        const std::vector<double> places = numbers(index, 3);
        if (mesh_.vertices.size() + places.size() / 3 > 3 * k_most_triangles)
            throw InputError(file_, "has too many vertices");
        for (std::size_t i = 0; i < places.size(); i += 3) {
            const glm::dvec4 placed =
                matrix * glm::dvec4(places[i], places[i + 1], places[i + 2], 1);
            if (!std::isfinite(placed.x + placed.y + placed.z))
                throw InputError(file_, "has a vertex that is not a number");
            mesh_.vertices.emplace_back(placed.x, placed.y, placed.z);
        }
        return static_cast<int>(places.size() / 3);
    }

    std::vector<std::array<int, 3>> triangles_of(const tinygltf::Primitive& primitive,
                                                 int vertices) const {
        std::vector<int> corners;
        if (primitive.indices < 0) {
            for (int i = 0; i < vertices; ++i) corners.push_back(i);
        } else {
            for (const double corner : numbers(primitive.indices, 1)) {
                if (!(corner >= 0 && corner < vertices))
                    throw InputError(
                        file_, fmt::format("a triangle names vertex {} of {}", corner, vertices));
                corners.push_back(static_cast<int>(corner));
            }
        }
        // Every other triangle of a strip runs the other way (specification, 3.7.2.1).
        std::vector<std::array<int, 3>> triangles;
        const bool strip = primitive.mode == TINYGLTF_MODE_TRIANGLE_STRIP,
                   fan = primitive.mode == TINYGLTF_MODE_TRIANGLE_FAN;
        for (std::size_t i = 0; i + 2 < corners.size(); i += strip || fan ? 1 : 3) {
            const int first = corners[fan ? 0 : i];
            const bool swapped = strip && i % 2 == 1;
            triangles.push_back(
                {first, corners[swapped ? i + 2 : i + 1], corners[swapped ? i + 1 : i + 2]});
        }
        return triangles;
    }

    const tinygltf::Model& model_;
    const std::filesystem::path& file_;
    TriangleMesh mesh_;
};

bool pass_over_image(tinygltf::Image*, const int, std::string*, std::string*, int, int,
                     const unsigned char*, int, void*) {
    return true;
}

// Extensions that are read, or that do not change where a surface lies.
bool is_extension_known(const std::string& name) {
    if (name == "KHR_mesh_quantization" || name == "EXT_mesh_gpu_instancing") return true;
    for (const char* of_looks : {"KHR_materials_", "KHR_texture_", "EXT_texture_", "KHR_lights_",
                                 "MSFT_texture_", "KHR_xmp"}) {
        if (name.rfind(of_looks, 0) == 0) return true;
    }
    return false;
}

// tinygltf reports unknown extensions as other errors or not at all.
void require_known_extensions(std::string_view json, const std::filesystem::path& file) {
    const auto root = nlohmann::json::parse(json, nullptr, false);
    if (!root.is_object() || !root.contains("extensionsRequired")) return;
    for (const auto& required : root["extensionsRequired"]) {
        const std::string name = required.is_string() ? required.get<std::string>() : "";
        if (is_extension_known(name)) continue;
        const bool packed = name == "KHR_draco_mesh_compression" ||
                            name == "EXT_meshopt_compression" || name == "KHR_meshopt_compression";
        throw InputError(
            file,
            packed ? fmt::format("is compressed ({}), which is not read: export it without "
                                 "compression (in Blender, leave Compression off)",
                                 name)
                   : fmt::format("requires the glTF extension {}, which is not known here: export "
                                 "it without",
                                 shown(name)));
    }
}

std::string_view chunk_at(std::string_view bytes, std::size_t at) {
    constexpr std::size_t k_before = 8;
    std::uint32_t length = 0;
    if (bytes.size() < at + k_before) return {};
    std::memcpy(&length, bytes.data() + at, sizeof length);
    return bytes.substr(at + k_before, length);
}

std::string_view json_of(std::string_view bytes, bool binary) {
    if (!binary) return bytes;
    // A header of 12 bytes, then the length and type of each chunk: JSON, and the buffer without a
    // name (specification, 4.4).
    return chunk_at(bytes, 12);
}

// Other programs accept a stated length that is too short, too.
void take_whole_buffer(std::string_view bytes, tinygltf::Model& model) {
    if (model.buffers.empty() || !model.buffers[0].uri.empty()) return;
    const std::string_view whole = chunk_at(bytes, 20 + chunk_at(bytes, 12).size());
    std::vector<unsigned char>& data = model.buffers[0].data;
    if (whole.size() > data.size()) data.assign(whole.begin(), whole.end());
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
    if (bytes.empty()) throw InputError(file, "is empty");
    // A byte order mark may stand before the brace.
    if (!binary && bytes.find_first_not_of("\xEF\xBB\xBF \t\r\n") != bytes.find('{'))
        throw InputError(file, "is not glTF: it begins neither with glTF nor with {");
    const std::string folder = file.parent_path().string();
    require_known_extensions(json_of(bytes, binary), file);
    const bool read =
        binary ? loader.LoadBinaryFromMemory(&model, &error, &warning,
                                             reinterpret_cast<const unsigned char*>(bytes.data()),
                                             size, folder)
               : loader.LoadASCIIFromString(&model, &error, &warning, bytes.data(), size, folder);
    if (!read) {
        // Only the first line of tinygltf's message, which may quote the file.
        throw InputError(file,
                         "is not glTF that can be read: " + error.substr(0, error.find('\n')));
    }
    if (binary) take_whole_buffer(bytes, model);
    return Reader(model, file).scene();
}

}  // namespace culet
