#pragma once
// Rays that are reflected and refracted as mirrors and glass do it, and lights of one place with
// shadows (Whitted, An improved illumination model for shaded display, CACM 23(6), 1980), in three
// primaries.

#include <cstdint>
#include <memory>
#include <vector>

#include "render/objects/object_world.h"
#include "render/shaded/plain_lights.h"
#include "render/shaded/plain_surface.h"

namespace culet {

/// - Diffuse: ambient light, and each light that nothing opaque hides, by Lambert's law. Stones and
///   glass hide nothing.
/// - Metal: the mirror direction with Fresnel's equations for its index; rough ones turn it by a
///   point of a ball of radius roughness^2, chosen at random (Cook et al. 1984 made such reflexes
///   with many rays). Mirror: its albedo.
/// - Glass and stones: both reflected and refracted rays, with Fresnel's equations for unpolarised
///   light, absorbed along the way; of a stone the mean index of its rays at 589.3 nm, no
///   dispersion, no double refraction.
/// - What a ray meets last is the lights themselves, as they are seen.
class WhittedTracer {
public:
    /// `depth`: faces that a ray may meet one after the other.
    WhittedTracer(const Scene& scene, int depth);

    struct Seen {
        Rgb colour{0, 0, 0};
        bool met = false;
    };
    /// `number`: of the ray in the picture.
    Seen trace(const EyeRay& ray, std::uint64_t number) const;

private:
    struct Ray {
        Vec3 origin, direction;
        RayStart start;
        int glass = -1;      ///< object that it runs inside
        int faces = 0;       ///< met before
        double weight = 1;   ///< at most, of what it brings
        std::uint64_t seed;  ///< of what is chosen at random along it
    };
    struct Surface {
        PlainSurface plain;
        MetalIndex metal;  ///< of a metal
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
