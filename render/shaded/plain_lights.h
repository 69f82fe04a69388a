#pragma once
// The lights of a scene as the plain shadings have them: an ambient light, and lights that shine
// from one place or from one direction.

#include <vector>

#include "render/reference/light_field.h"
#include "render/scene/scene.h"

namespace culet {

/// Light from one place, or (distant) from one direction. Spheres shine from their centres, flat
/// lights from their middles, caps and lobes from their directions.
struct PlainLight {
    bool distant = false;
    Vec3 at{0, 0, 0};      ///< or the unit direction towards it
    Vec3 normal{0, 0, 0};  ///< of a flat light, which shines with the cosine; 0: alike to all sides
    Rgb strength{0, 0, 0};       ///< what a white surface that faces it shows at the scene's middle
    double middle_distance = 1;  ///< from there to the light
};

/// What a light sends to a point.
struct Incoming {
    Vec3 direction{0, 0, 1};  ///< unit, towards the light
    double distance = 0;      ///< infinite from distant lights
    Rgb strength{0, 0, 0};    ///< attenuated
};

class PlainLights {
public:
    /// `middle`: of the scene, from which attenuation counts.
    PlainLights(const Scene& scene, const Vec3& middle);

    /// Mean over all directions of the light that has no place: constant, environment, hemispheres,
    /// endless planes.
    const Rgb& ambient() const { return ambient_; }
    const std::vector<PlainLight>& lights() const { return lights_; }
    Incoming incoming(const PlainLight& light, const Vec3& point) const;

    /// The lights themselves as they are seen along a ray that meets nothing else.
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
