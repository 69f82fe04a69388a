#pragma once
// The surroundings of the main stone in a scene with objects.

#include "render/objects/object_paths.h"
#include "render/reference/surroundings.h"

namespace culet {

/// Rays start outside the stone, or on it when they leave it for good. It hides nothing from these
/// rays, but objects that they hit see it. The ray and the seed determine all random choices.
class ObjectSurroundings : public Surroundings {
public:
    ObjectSurroundings(const Scene& scene, const WavelengthSet& wavelengths)
        : scene_(scene, wavelengths) {}

    void add_radiance(const Vec3& origin, const Vec3& direction, double weight, int first,
                      int count, double* radiance) const override;
    void add_stokes(const PathEnd& end, int first, int count, double* stokes,
                    int stride) const override;
    void add_direct_stokes(const EyeRay& ray, const EyeFrame& frame, int nodes,
                           double* stokes) const override;
    double nearest_distance(const Vec3& origin, const Vec3& direction) const override;
    bool stands_at(const Vec3& origin, const Vec3& direction) const override;
    std::string name_at(const Vec3& origin, const Vec3& direction) const override;
    double max_radiance() const override { return scene_.brightest; }
    double spent_ns() const override { return static_cast<double>(scene_.spent_ns); }

private:
    WorldRay ray(const Vec3& origin, const Vec3& direction, const Vec3& u, const Vec3& v) const;
    /// The nearest object or stone, if no light is nearer.
    WorldHit first_hit(const Vec3& origin, const Vec3& direction) const;
    /// Returns the weight of the light; 0 if it was left out by chance.
    double ask(WorldRay ray, double weight, int first, int count, int planes,
               ArrivingLight& light) const;
    SceneWithObjects scene_;
};

}  // namespace culet
