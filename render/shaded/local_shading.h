#pragma once
// Local shading from lights and surface alone: flat, Gouraud, Phong.

#include <optional>
#include <vector>

#include "render/shaded/faceted_bodies.h"
#include "render/shaded/plain_lights.h"

namespace culet {

/// Illumination model of Phong (Illumination for computer generated pictures, CACM 18(6), 1975):
/// ambient k_a A C + sum over lights of L (k_d C max(0, n.l) + k_s S max(0, r.v)^m), with colour C
/// and highlight S of the surface, ambient light A, and light L attenuated by distance. `normal`
/// and `toward_eye` are unit; a normal that faces away from the eye is turned round.
Rgb local_radiance(const PlainShading& shading, const PlainLights& lights,
                   const PlainSurface& surface, const Vec3& at, Vec3 normal,
                   const Vec3& toward_eye);

enum class LocalShading {
    flat,     ///< one colour per facet, computed at its middle
    gouraud,  ///< colours of the corners, interpolated (Gouraud 1971)
    phong     ///< normals of the corners, interpolated; spheres have their own
};

class LocalShader {
public:
    LocalShader(const Scene& scene, LocalShading shading);

    struct Seen {
        Rgb colour{0, 0, 0};
        bool met = false;  ///< met a stone or an object, not only lights
    };
    Seen shade(const EyeRay& ray) const;

private:
    Vec3 toward_eye(const Vec3& at) const;
    Rgb colour_at(int body, const Vec3& at, const Vec3& normal) const;
    Rgb colour_of(const WorldHit& hit, const Vec3& at) const;

    LocalShading kind_;
    PlainShading shading_;
    Vec3 eye_;
    std::optional<Vec3> toward_eye_;  ///< for parallel views, the same everywhere
    FacetedBodies bodies_;
    PlainLights lights_;
    /// Per body: colours of its facets (flat), or of its triangles' corners (Gouraud).
    std::vector<std::vector<Rgb>> facet_colours_;
    std::vector<std::vector<std::array<Rgb, 3>>> corner_colours_;
};

}  // namespace culet
