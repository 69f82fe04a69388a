#pragma once
// Whitted ray tracing in three primaries: mirrors, refraction, point lights with shadows (Whitted,
// An improved illumination model for shaded display, CACM 23(6), 1980).

#include <cstdint>
#include <memory>
#include <vector>

#include "render/objects/object_world.h"
#include "render/shaded/plain_lights.h"
#include "render/shaded/plain_surface.h"

namespace culet {

/// - Diffuse: ambient light, and each light that nothing opaque hides, by Lambert's law. Stones and
///   glass cast no shadows.
/// - Metal: mirror reflection by Fresnel's equations for its index. Rough metal shifts the
///   direction by a random point of a ball of radius roughness^2 (Cook et al. 1984 used many rays).
///   Mirror: its albedo.
/// - Glass and stones: reflected and refracted rays by Fresnel's equations for unpolarised light,
///   absorbed along the way. A stone has its mean index at 589.3 nm, without dispersion and double
///   refraction.
/// - A ray that leaves the scene sees the lights themselves.
class WhittedTracer {
public:
    /// `depth`: most faces that a ray meets in a row.
    WhittedTracer(const Scene& scene, int depth);

    struct Seen {
        Rgb colour{0, 0, 0};
        bool met = false;
    };
    /// `number`: index of the ray in the picture.
    Seen trace(const EyeRay& ray, std::uint64_t number) const;

private:
    struct Ray {
        Vec3 origin, direction;
        RayStart start;
        int glass = -1;      ///< index of the object that it is inside
        int faces = 0;       ///< faces met before
        double weight = 1;   ///< upper bound on the ray's share of the pixel
        std::uint64_t seed;  ///< of random choices along it
    };
    struct Surface {
        PlainSurface plain;
        MetalIndex metal;
        double fuzz = 0, index = 1;
        Rgb absorption{0, 0, 0};
    };
    struct Gem {
        double index = 1;
        Rgb absorption{0, 0, 0};
    };

    Rgb colour_along(const Ray& ray) const;
    Rgb colour_of_hit(const Ray& ray, const WorldHit& hit, const Vec3& at) const;
    Rgb diffuse(const WorldHit& hit, const Vec3& at, const Vec3& normal) const;
    Rgb reflected(const Ray& ray, const WorldHit& hit, const Vec3& at, const Vec3& normal) const;
    Rgb through_glass(const Ray& ray, const WorldHit& hit, const Vec3& at) const;
    Rgb onto_stone(const Ray& ray, int stone, int facet, const Vec3& at) const;
    Rgb inside_stone(const Ray& ray, int stone, int facet) const;
    Rgb off_stone(const Ray& ray, int stone, int facet) const;
    bool hidden(const Vec3& from, const Incoming& light, const RayStart& start) const;
    bool too_deep(const Ray& ray) const { return ray.faces >= depth_; }
    Ray next(const Ray& ray, const Vec3& at, const Vec3& direction, double share, int branch) const;

    ObjectWorld world_;
    PlainShading shading_;
    PlainLights lights_;
    std::vector<Surface> surfaces_;
    std::vector<Gem> gems_;
    double outside_;
    int depth_;
    std::uint64_t seed_;
};

}  // namespace culet
