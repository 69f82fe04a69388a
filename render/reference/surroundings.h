#pragma once
// What stands around the stone, asked by the light paths that leave it, and by rays that miss it.

#include <memory>
#include <string>

#include "render/optics/path.h"
#include "render/scene/scene.h"

namespace culet {

/// Made ready for one set of wavelengths ("nodes"). Rays start at `origin` and look along the unit
/// `direction`. May be asked from any thread.
class Surroundings : public Obstacles {
public:
    /// Adds `weight` times the radiance that arrives along a ray at node `first` ..
    /// `first + count - 1` to `radiance[0 .. count - 1]`. What is sampled at random is sampled the
    /// less, the smaller the weight.
    virtual void add_radiance(const Vec3& origin, const Vec3& direction, double weight, int first,
                              int count, double* radiance) const = 0;
    /// The Stokes parameters that reach the eye through the two waves of a path's end, times its
    /// transmission, are added to `stokes[k * stride + node]`, k = 0..3.
    virtual void add_stokes(const PathEnd& end, int first, int count, double* stokes,
                            int stride) const = 0;
    /// The same of light that reaches the eye directly, at all `nodes`.
    virtual void add_direct_stokes(const EyeRay& ray, const EyeFrame& frame, int nodes,
                                   double* stokes) const = 0;
    /// Whether a thing, and no light, is the nearest.
    virtual bool stands_at(const Vec3& origin, const Vec3& direction) const = 0;
    /// What is seen there, for people: "environment", "sphere 0", ...
    virtual std::string name_at(const Vec3& origin, const Vec3& direction) const = 0;
    /// Largest radiance at any node, for bounds.
    virtual double max_radiance() const = 0;
    /// What all answers so far took, at the prices of work/price.h; 0: part of who asks.
    virtual double spent_ns() const { return 0; }
};

/// Of a scene: its lights, and what stands around its stone (objects/object_surroundings.cpp).
std::unique_ptr<const Surroundings> surroundings_of(const Scene& scene,
                                                    const WavelengthSet& wavelengths);

}  // namespace culet
