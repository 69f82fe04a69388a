#pragma once
// How many lights of each kind the kernel has, and the uniforms that they take.

#include "render/scene/lights.h"

namespace culet {

struct LightCounts {
    int spheres = 0, planes = 0, lobes = 0, caps = 0;  ///< caps: hemispheres too

    int all() const { return spheres + planes + lobes + caps; }
    /// Of vectors of four, wavelengths apart.
    int vectors() const { return spheres + 3 * planes + 2 * lobes + 2 * caps + 2 * all() + 2; }
};

inline LightCounts count_lights(const Lights& lights) {
    const auto count = []<class L>(const Lights& of) {
        return static_cast<int>(count_lights<L>(of));
    };
    return {count.operator()<SphereLight>(lights), count.operator()<PlaneLight>(lights),
            count.operator()<CosinePowerLight>(lights),
            count.operator()<HemisphereLight>(lights) + count.operator()<DiscLight>(lights)};
}

}  // namespace culet
