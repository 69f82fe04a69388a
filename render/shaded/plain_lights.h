#pragma once
// The lights of a scene as the local shadings see them: an ambient light, and lights that shine
// from one point or one direction.

#include <optional>
#include <vector>

#include "render/reference/light_field.h"
#include "render/scene/scene.h"

namespace culet {

/// A light at one point, or at infinity (distant). Spheres shine from their centres, flat lights
/// from their middles, caps and lobes from their directions.
struct PlainLight {
    bool distant = false;
    Vec3 at{0, 0, 0};  ///< position, or unit direction towards a distant light
    /// of a flat light, which shines with the cosine; 0: isotropic
    Vec3 normal{0, 0, 0};
    Rgb strength{0, 0, 0};       ///< radiance of a white surface facing it, at the scene's middle
    double middle_distance = 1;  ///< from the scene's middle
    std::optional<LampLight> lamp = {};  ///< whose intensity depends on the direction
};

/// The light that reaches a point.
struct Incoming {
    Vec3 direction{0, 0, 1};
    double distance = 0;    ///< infinite for distant lights
    Rgb strength{0, 0, 0};  ///< attenuated
};

class PlainLights {
public:
    /// `middle`: of the scene. Attenuation uses distances over that from the light to here.
    PlainLights(const Scene& scene, const Vec3& middle);

    /// Mean over all directions of light without a position: constant, environment, hemispheres,
    /// infinite planes.
    const Rgb& ambient() const { return ambient_; }
    const std::vector<PlainLight>& lights() const { return lights_; }
    Incoming incoming(const PlainLight& light, const Vec3& point) const;

    /// Radiance of the lights along a ray that meets nothing else.
    Rgb seen(const Vec3& origin, const Vec3& direction) const;
    double nearest_distance(const Vec3& origin, const Vec3& direction) const {
        return field_.nearest_distance(origin, direction);
    }

private:
    void add(const Light& light, const Vec3& middle);
    Rgb rgb_of(const LightColour& colour) const;

    std::array<double, 3> attenuation_;
    WavelengthSet wavelengths_;
    LightField field_;
    Rgb ambient_{0, 0, 0};
    std::vector<PlainLight> lights_;
};

inline Rgb operator*(double factor, const Rgb& colour) {
    return {factor * colour[0], factor * colour[1], factor * colour[2]};
}
inline Rgb operator*(const Rgb& a, const Rgb& b) {
    return {a[0] * b[0], a[1] * b[1], a[2] * b[2]};
}
inline Rgb operator+(const Rgb& a, const Rgb& b) {
    return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
inline Rgb& operator+=(Rgb& a, const Rgb& b) {
    return a = a + b;
}

}  // namespace culet
