#pragma once
// Counts the kernel's lights of each kind and the uniforms that they take.

#include "render/scene/lights.h"

namespace culet {

struct LightCounts {
    /// Spheres include lamps, caps hemispheres.
    int spheres = 0, planes = 0, lobes = 0, caps = 0, lamps = 0;

    int all() const { return spheres + planes + lobes + caps; }
    /// In vectors of four, without those per wavelength.
    int vectors() const {
        return spheres + 3 * planes + 2 * lobes + 2 * caps + 2 * lamps + 2 * all() + 2;
    }
};

inline LightCounts count_lights(const Lights& lights) {
    LightCounts counts;
    struct Count {
        LightCounts& counts;
        void operator()(const SphereLight&) const { ++counts.spheres; }
        void operator()(const PlaneLight&) const { ++counts.planes; }
        void operator()(const LampLight&) const {
            ++counts.spheres;
            ++counts.lamps;
        }
        void operator()(const CosinePowerLight&) const { ++counts.lobes; }
        void operator()(const HemisphereLight&) const { ++counts.caps; }
        void operator()(const DiscLight&) const { ++counts.caps; }
    };
    for (const Light& light : lights.sources) std::visit(Count{counts}, light);
    return counts;
}

}  // namespace culet
