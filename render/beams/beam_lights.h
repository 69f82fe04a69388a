#pragma once
// Lights as the shading of beams wants them: single precision, about the stone's middle, and an
// environment that is averaged beforehand over what a ray's pixel sees of it.

#include <array>
#include <memory>
#include <vector>

#include "render/beams/environment_pyramid.h"
#include "render/scene.h"

namespace culet {

/// Spheres and planes together.
constexpr int k_most_near_lights = 16;

struct ShadedLights {
    ShadedLights() = default;
    ShadedLights(const Lights& lights, const WavelengthSet& colours, int first, int count,
                 const Vec3& middle, std::shared_ptr<const EnvironmentPyramid> environment);

    struct Lobe {
        float x, y, z, exponent;
        int whole;  ///< the exponent when it is a small whole number, else -1
        std::vector<float> radiance;
    };
    struct Cap {  ///< or half of all directions: angle cosines in (to, from]
        float x, y, z, from, to;
        std::vector<float> radiance;
    };
    struct Sphere {
        float x, y, z, radius;
        std::vector<float> radiance;
    };
    struct Plane {
        float x, y, z, offset;
        bool bounded;
        float s[4], t[4];  ///< coordinates of a point along u and v, as a row; lit within -1..1
        std::vector<float> radiance;
    };

    int nodes = 1;
    bool any_edge = false;  ///< lights whose radiance jumps, or an environment
    std::vector<float> constant;
    std::vector<Lobe> lobes;
    std::vector<Cap> caps;
    std::vector<Sphere> spheres;
    std::vector<Plane> planes;
    std::shared_ptr<const EnvironmentPyramid> environment;
    /// Of each node: what red and blue add to green.
    std::vector<float> red, blue;
};

}  // namespace culet
