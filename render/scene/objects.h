#pragma once
// What stands around the stone: shapes and what they are made of. Lengths in the stone's unit,
// angles in radians. docs/rendering.md has the keys of scene files.

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
    Vec3 half{0.5, 0.5, 0.5};                                       ///< of the edges along them
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

/// Lambert's: the same radiance in all directions, unpolarised.
struct DiffuseMaterial {
    static constexpr const char* k_name = "diffuse";
    SurfaceColour albedo;
};
/// Fresnel's equations for a complex index.
struct MetalMaterial {
    static constexpr const char* k_name = "metal";
    SurfaceColour n, k;  ///< n + i k; or, where there is `f0`, unused
    /// Reflectance at normal incidence, 0..1: the index is 1 + i k then, with k to match. What that
    /// reflects at a slant lies between real metals. Of 1: an ideal conductor.
    std::optional<SurfaceColour> f0;
    /// 0: polished. Else microfacets (GGX) of alpha = roughness^2, as glTF and Blender have it.
    double roughness = 0;
};
/// Reflects the same share at every angle, and turns polarisation as an ideal conductor does.
struct MirrorMaterial {
    static constexpr const char* k_name = "mirror";
    SurfaceColour albedo;
};
/// Clear or coloured glass; the shape must be closed.
struct DielectricMaterial {
    static constexpr const char* k_name = "dielectric";
    double index = 1.5;
    SurfaceColour absorption{0.0};  ///< Napierian, per length
};
/// Shines to all sides alike, and reflects nothing.
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
