#pragma once
// Objects around the stone: shapes and materials. Lengths in the stone's unit, angles in radians.

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "render/scene/lights.h"
#include "stone/mesh/surface_mesh.h"

namespace culet {

struct SphereShape {
    static constexpr const char* k_name = "sphere";
    Vec3 center{0, 0, 0};
    double radius = 1;
};
/// Infinite.
struct PlaneShape {
    static constexpr const char* k_name = "plane";
    Vec3 point{0, 0, 0}, normal{0, 0, 1};
};
struct DiscShape {
    static constexpr const char* k_name = "disc";
    Vec3 center{0, 0, 0}, normal{0, 0, 1};
    double radius = 1;
};
struct BoxShape {
    static constexpr const char* k_name = "box";
    Vec3 center{0, 0, 0};
    std::array<Vec3, 3> axes{Vec3{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};  ///< orthonormal
    Vec3 half{0.5, 0.5, 0.5};                                       ///< half edge lengths, along
                                                                    ///< `axes`
};
struct MeshShape {
    static constexpr const char* k_name = "mesh";
    std::shared_ptr<const TriangleMesh> mesh;
};
using Shape = std::variant<SphereShape, PlaneShape, DiscShape, BoxShape, MeshShape>;

/// One number for all wavelengths, or red, green and blue.
struct SurfaceColour {
    std::variant<double, Rgb> value = 1.0;
};

/// Lambertian: the same radiance in all directions, unpolarised.
struct DiffuseMaterial {
    static constexpr const char* k_name = "diffuse";
    SurfaceColour albedo;
};
/// Fresnel's equations for a complex index.
struct MetalMaterial {
    static constexpr const char* k_name = "metal";
    SurfaceColour n, k;  ///< n + i k; unused if `f0` is set
    /// Reflectance at normal incidence, 0..1; the index is then 1 + i k. At oblique incidence this
    /// lies between real metals. 1: an ideal conductor.
    std::optional<SurfaceColour> f0;
    /// 0: polished. Else GGX microfacets with alpha = roughness^2, as in glTF and Blender.
    double roughness = 0;
};
/// Reflects the same part at every angle, and changes polarisation like an ideal conductor.
struct MirrorMaterial {
    static constexpr const char* k_name = "mirror";
    SurfaceColour albedo;
};
/// Clear or coloured glass. The shape must be closed.
struct DielectricMaterial {
    static constexpr const char* k_name = "dielectric";
    double index = 1.5;
    SurfaceColour absorption{0.0};  ///< Napierian, per unit of length
};
/// Emits equally to all sides, and reflects nothing.
struct EmitterMaterial {
    static constexpr const char* k_name = "emitter";
    LightColour radiance;
};
using SurfaceMaterial = std::variant<DiffuseMaterial, MetalMaterial, MirrorMaterial,
                                     DielectricMaterial, EmitterMaterial>;

struct SceneObject {
    Shape shape;
    SurfaceMaterial material;
};

}  // namespace culet
