#pragma once
// Radiance around the stone, as seen by light paths that leave it and by rays that miss it.

#include <memory>
#include <string>

#include "render/optics/path.h"
#include "render/scene/scene.h"

namespace culet {

/// Holds one set of wavelengths ("nodes"). Rays start at `origin` and look along the unit
/// `direction`. Thread-safe.
class Surroundings : public Obstacles {
public:
    /// Adds `weight` times the radiance along a ray at the nodes `first` .. `first + count - 1` to
    /// `radiance[0 .. count - 1]`. The smaller the weight, the fewer random samples are taken.
    virtual void add_radiance(const Vec3& origin, const Vec3& direction, double weight, int first,
                              int count, double* radiance) const = 0;
    /// Adds the Stokes parameters that reach the eye through the two waves of an exit, times its
    /// transmission, to `stokes[k * stride + node]`, k = 0..3.
    virtual void add_stokes(const PathEnd& end, int first, int count, double* stokes,
                            int stride) const = 0;
    /// The same for light that reaches the eye directly, at all `nodes`.
    virtual void add_direct_stokes(const EyeRay& ray, const EyeFrame& frame, int nodes,
                                   double* stokes) const = 0;
    /// True if the nearest thing is an object, not a light.
    virtual bool stands_at(const Vec3& origin, const Vec3& direction) const = 0;
    /// Name for reports of what is seen: "environment", "sphere 0", ...
    virtual std::string name_at(const Vec3& origin, const Vec3& direction) const = 0;
    /// Largest radiance at any node.
    virtual double max_radiance() const = 0;
    /// Work of all answers so far, at the prices of work/price.h; 0: counted by the caller.
    virtual double spent_ns() const { return 0; }
};

/// Returns the scene's lights and objects as surroundings (objects/object_surroundings.cpp).
std::unique_ptr<const Surroundings> surroundings_of(const Scene& scene,
                                                    const WavelengthSet& wavelengths);

}  // namespace culet
