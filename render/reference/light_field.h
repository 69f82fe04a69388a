#pragma once
// The lights of a scene, asked from a path's end.

#include <memory>
#include <string>

#include "render/scene/scene.h"

namespace culet {

struct PathEnd;  // path.h

/// The lights made ready for one set of wavelengths. Near lights (spheres, planes) hide the distant
/// ones behind them; the nearest wins. Distant ones add up.
class LightField {
public:
    LightField(const Lights& lights, const WavelengthSet& wavelengths);
    ~LightField();
    LightField(LightField&&) noexcept;

    /// Adds `weight` times the radiance that arrives along a ray (from `origin` looking along the
    /// unit `direction`) at node `first` .. `first + count - 1` to `radiance[0 .. count - 1]`.
    /// Returns the light's name for people: "environment", "sphere 0", ...
    void add_radiance(const Vec3& origin, const Vec3& direction, double weight, int first,
                      int count, double* radiance) const;
    /// The Stokes parameters that reach the eye through the two waves of a path's end, times its
    /// transmission, are added to `stokes[k * stride + node]`, k = 0..3.
    void add_stokes(const PathEnd& end, int first, int count, double* stokes, int stride) const;
    /// The same of light that reaches the eye directly, at all `nodes`.
    void add_direct_stokes(const EyeRay& ray, const EyeFrame& frame, int nodes,
                           double* stokes) const;
    /// How far along the ray the nearest near light is: it hides what lies behind it. Infinite when
    /// there is none.
    double nearest_distance(const Vec3& origin, const Vec3& direction) const;
    std::string name_at(const Vec3& origin, const Vec3& direction) const;
    /// Largest radiance of any light at any node, for bounds.
    double max_radiance() const;

private:
    struct Ready;
    std::unique_ptr<Ready> ready_;
};

}  // namespace culet
