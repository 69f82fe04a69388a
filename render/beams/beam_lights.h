#pragma once
// Lights for shading beams: in single precision, relative to the stone's middle, with the
// environment prefiltered over what a ray's pixel sees of it.

#include <array>
#include <memory>
#include <vector>

#include "render/beams/environment_pyramid.h"
#include "render/scene/scene.h"

namespace culet {

/// Spheres, lamps and planes together.
constexpr int k_most_near_lights = 16;

struct ShadedLights {
    ShadedLights() = default;
    ShadedLights(const Lights& lights, const WavelengthSet& colours, int first, int count,
                 const Vec3& middle, std::shared_ptr<const EnvironmentPyramid> environment);

    /// Degree 0: unpolarised. A ray vibrates along `along`: turned with the sheet's normal into the
    /// ray if there is a sheet, else projected.
    struct Polarised {
        float degree = 0;
        bool sheet = false;
        float along[3] = {1, 0, 0}, normal[3] = {0, 0, 1};
    };

    struct Lobe {
        float x, y, z, exponent;
        int whole;  ///< the exponent if it is a small integer, else -1
        std::vector<float> radiance;
        Polarised polarised;
    };
    struct Disc {
        float cosine, sine;  ///< of the angle from its middle to its rim
    };
    struct Cap {  ///< within `outer` but not `inner`; or half of all directions
        float x, y, z;
        Disc outer, inner;
        std::vector<float> radiance;
        Polarised polarised;
    };
    struct Sphere {
        float x, y, z, radius;
        std::vector<float> radiance;
        Polarised polarised;
        std::shared_ptr<const LampLight> lamp;  ///< if its radiance depends on the direction
    };
    struct Plane {
        float x, y, z, offset;
        bool bounded;
        float s[4], t[4];  ///< row vectors: coordinates of a point along u and v; lit within -1..1
        std::vector<float> radiance;
        Polarised polarised;
    };

    int nodes = 1;
    bool any_edge = false;  ///< there are lights with edges, or an environment
    std::vector<float> constant;
    Polarised surroundings;  ///< of the constant light and the environment
    std::vector<Lobe> lobes;
    std::vector<Cap> caps;
    std::vector<Sphere> spheres;
    std::vector<Plane> planes;
    std::shared_ptr<const EnvironmentPyramid> environment;
    /// Per node: what red and blue add to green.
    std::vector<float> red, blue;

private:
    struct Adder;
};

}  // namespace culet
