// glTF 2.0 (Khronos, ISO/IEC 12113:2022), by tinygltf.

#include "stone/export/gltf_write.h"

#include <fmt/format.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <sstream>

#include "stone/export/mean_material.h"
#include "stone/solid/facet_triangles.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

using tinygltf::Value;

constexpr double k_metres_per_mm = 1e-3;

// glTF's up is +y; ours is +z.
std::array<float, 3> turned_up(const Vec3& v) {
    return {static_cast<float>(v.x), static_cast<float>(v.z), static_cast<float>(0 - v.y)};
}

Value list_of(std::initializer_list<double> numbers) {
    Value::Array list;
    for (const double number : numbers) list.emplace_back(number);
    return Value(list);
}

struct GltfMesh {
    std::vector<std::array<float, 3>> positions, normals;
    std::vector<std::uint32_t> indices;
    Value::Array facets;
};

GltfMesh mesh_of(const Stone& stone) {
    const Solid& solid = stone.solid;
    GltfMesh mesh;
    for (const Facet& facet : solid.facets) {
        const Vec3& n = facet.plane.normal;
        const auto first_corner = static_cast<std::uint32_t>(mesh.positions.size());
        const std::size_t first_triangle = mesh.indices.size() / 3;
        for (const int corner : facet.corners) {
            mesh.positions.push_back(
                turned_up(k_metres_per_mm * solid.vertices[static_cast<std::size_t>(corner)]));
            mesh.normals.push_back(turned_up(glm::normalize(n)));
        }
        for (const std::array<int, 3>& triangle : facet_triangles(solid, facet)) {
            for (const int corner : triangle) {
                const auto at = std::find(facet.corners.begin(), facet.corners.end(), corner);
                mesh.indices.push_back(first_corner +
                                       static_cast<std::uint32_t>(at - facet.corners.begin()));
            }
        }
        const std::size_t triangles = mesh.indices.size() / 3 - first_triangle;
        mesh.facets.emplace_back(Value::Object{
            {"name", Value(facet.name)},
            {"first_triangle", Value(static_cast<int>(first_triangle))},
            {"triangles", Value(static_cast<int>(triangles))},
            {"normal", list_of({n.x, n.y, n.z})},
            {"offset_mm", Value(facet.plane.offset)},
            {"inclination_deg", Value(degrees(inclination(n, {0, 0, 1})))},
            {"azimuth_deg", Value(degrees(azimuth(n)))},
            {"area_mm2", Value(area(solid, facet))},
        });
    }
    return mesh;
}

class GltfWriter {
public:
    GltfWriter(const Stone& stone, const std::optional<GltfLook>& look)
        : stone_(stone), look_(look) {}

    std::string write(GltfForm form) {
        model_.asset.version = "2.0";
        model_.asset.generator = "culet";
        model_.buffers.emplace_back();
        add_mesh(mesh_of(stone_));
        add_material();
        add_scene();
        std::ostringstream stream;
        tinygltf::TinyGLTF writer;
        const bool binary = form == GltfForm::binary;
        check(writer.WriteGltfSceneToStream(&model_, stream, !binary, binary),
              "glTF could not be written");
        return stream.str();
    }

private:
    // Aligns to a multiple of four bytes.
    template <class T>
    int add_view(const std::vector<T>& elements, int target) {
        std::vector<unsigned char>& data = model_.buffers[0].data;
        tinygltf::BufferView view;
        view.buffer = 0;
        view.byteOffset = data.size();
        view.byteLength = elements.size() * sizeof(T);
        view.target = target;
        data.resize((view.byteOffset + view.byteLength + 3) / 4 * 4);
        std::memcpy(data.data() + view.byteOffset, elements.data(), view.byteLength);
        model_.bufferViews.push_back(view);
        return static_cast<int>(model_.bufferViews.size()) - 1;
    }

    int add_accessor(int view, int type, int component, std::size_t count) {
        tinygltf::Accessor accessor;
        accessor.bufferView = view;
        accessor.type = type;
        accessor.componentType = component;
        accessor.count = count;
        model_.accessors.push_back(accessor);
        return static_cast<int>(model_.accessors.size()) - 1;
    }

    int add_vectors(const std::vector<std::array<float, 3>>& vectors) {
        return add_accessor(add_view(vectors, TINYGLTF_TARGET_ARRAY_BUFFER), TINYGLTF_TYPE_VEC3,
                            TINYGLTF_COMPONENT_TYPE_FLOAT, vectors.size());
    }

    int add_indices(const std::vector<std::uint32_t>& indices, std::size_t corners) {
        const int target = TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER;
        // The largest number of each type is reserved (primitive restart).
        if (corners < 0xffff) {
            const std::vector<std::uint16_t> narrow(indices.begin(), indices.end());
            return add_accessor(add_view(narrow, target), TINYGLTF_TYPE_SCALAR,
                                TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT, indices.size());
        }
        return add_accessor(add_view(indices, target), TINYGLTF_TYPE_SCALAR,
                            TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, indices.size());
    }

    void add_mesh(const GltfMesh& mesh) {
        tinygltf::Primitive primitive;
        const int positions = add_vectors(mesh.positions);
        std::array<float, 3> low = mesh.positions[0], high = low;
        for (const std::array<float, 3>& p : mesh.positions) {
            for (std::size_t k = 0; k < 3; ++k) {
                low[k] = std::min(low[k], p[k]);
                high[k] = std::max(high[k], p[k]);
            }
        }
        tinygltf::Accessor& accessor = model_.accessors[static_cast<std::size_t>(positions)];
        accessor.minValues.assign(low.begin(), low.end());
        accessor.maxValues.assign(high.begin(), high.end());
        primitive.attributes["POSITION"] = positions;
        primitive.attributes["NORMAL"] = add_vectors(mesh.normals);
        primitive.indices = add_indices(mesh.indices, mesh.positions.size());
        primitive.mode = TINYGLTF_MODE_TRIANGLES;
        primitive.material = 0;
        tinygltf::Mesh written;
        written.name = stone_.name;
        written.primitives.push_back(primitive);
        written.extras = Value(Value::Object{{"facets", Value(mesh.facets)}});
        model_.meshes.push_back(written);
    }

    void add_extension(tinygltf::Material& material, const char* name, Value::Object values) {
        material.extensions[name] = Value(std::move(values));
        // Not required: readers may draw without the extension.
        model_.extensionsUsed.emplace_back(name);
    }

    void add_material() {
        tinygltf::Material material;
        material.name = look_ ? stone_.material.id : "stone";
        tinygltf::PbrMetallicRoughness& surface = material.pbrMetallicRoughness;
        surface.metallicFactor = 0;
        if (!look_) {
            surface.baseColorFactor = {0.8, 0.8, 0.8, 1};
            surface.roughnessFactor = 0.5;
            model_.materials.push_back(material);
            return;
        }
        surface.roughnessFactor = 0;
        add_extension(material, "KHR_materials_ior", {{"ior", Value(look_->index)}});
        add_extension(material, "KHR_materials_transmission", {{"transmissionFactor", Value(1.0)}});
        const double thickness_mm = width_along(stone_.solid, {0, 0, 1});
        Value::Object volume{{"thicknessFactor", Value(k_metres_per_mm * thickness_mm)}};
        if (look_->attenuation_mm) {
            const std::array<double, 3>& rgb = look_->attenuation_colour;
            volume["attenuationDistance"] = Value(k_metres_per_mm * *look_->attenuation_mm);
            volume["attenuationColor"] = list_of({rgb[0], rgb[1], rgb[2]});
        }
        add_extension(material, "KHR_materials_volume", volume);
        if (look_->dispersion > 0) {
            add_extension(material, "KHR_materials_dispersion",
                          {{"dispersion", Value(look_->dispersion)}});
        }
        model_.materials.push_back(material);
    }

    void add_scene() {
        const Solid& solid = stone_.solid;
        const double mm3 = volume(solid);
        Value::Object about{
            {"size_mm", list_of({width_along(solid, {1, 0, 0}), width_along(solid, {0, 1, 0}),
                                 width_along(solid, {0, 0, 1})})},
            {"volume_mm3", Value(mm3)},
            {"facet_count", Value(static_cast<int>(solid.facets.size()))},
            {"frame", Value(std::string("extras: mm, z up, girdle plane at z = 0; mesh: glTF's "
                                        "metres, y up"))},
        };
        if (look_) {
            about["material"] = Value(stone_.material.id);
            about["index_587.6nm"] = Value(look_->index);
            if (const std::optional<double>& density = stone_.material.density_g_cm3) {
                about["density_g_cm3"] = Value(*density);
                about["weight_ct"] = Value(carat(mm3, *density));
            }
        }
        tinygltf::Node node;
        node.name = stone_.name;
        node.mesh = 0;
        node.extras = Value(about);
        model_.nodes.push_back(node);
        tinygltf::Scene scene;
        scene.nodes.push_back(0);
        model_.scenes.push_back(scene);
        model_.defaultScene = 0;
    }

    const Stone& stone_;
    const std::optional<GltfLook>& look_;
    tinygltf::Model model_;
};

}  // namespace

std::string gltf_bytes(const Stone& stone, const std::optional<GltfLook>& look, GltfForm form) {
    if (stone.solid.facets.empty()) throw InputError("there is no stone to write as glTF");
    return GltfWriter(stone, look).write(form);
}

GltfLook gltf_look_of(const Material& material) {
    // The Fraunhofer lines of KHR_materials_dispersion's Abbe number.
    constexpr double k_d_nm = 587.56, k_f_nm = 486.13, k_c_nm = 656.27;
    const double n_d = mean_index(material, k_d_nm);
    const double spread = mean_index(material, k_f_nm) - mean_index(material, k_c_nm);
    GltfLook look;
    look.index = n_d;
    look.dispersion = n_d > 1 && spread > 0 ? 20 * spread / (n_d - 1) : 0;
    return look;
}

}  // namespace culet
