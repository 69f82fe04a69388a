#pragma once
// A furnished scene as surroundings of the stone that it is about.

#include "render/objects/object_paths.h"
#include "render/reference/surroundings.h"

namespace culet {

/// Rays start outside the stone, or on it where they leave it for good: it hides nothing of what
/// they ask for at once, but what they meet sees it. What is chosen at random is fixed by the ray
/// and the seed.
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
    /// What is seen first, if it is no light.
    WorldHit first_hit(const Vec3& origin, const Vec3& direction) const;
    /// The light, and the factor that it counts with: 0 where it was left out by chance.
    double ask(WorldRay ray, double weight, int first, int count, int planes,
               ArrivingLight& light) const;
    SceneWithObjects scene_;
};

}  // namespace culet
