#pragma once
// Which effects a scene calls for, at which wavelengths, and what leaving one out may cost.

#include <array>
#include <string>
#include <vector>

#include "render/light_paths.h"
#include "render/scene.h"

namespace culet {

struct EffectDecision {
    Effects effect = Effects::dispersion;
    bool on = false;
    std::string why;
    /// Bound on the error of the radiance, relative to the largest light, of leaving it out; 0 when
    /// it is on or changes nothing. NaN: no bound is known (written as null).
    double error_bound = 0;
};

struct Plan {
    std::array<EffectDecision, k_effect_count> effects;
    std::vector<double> wavelengths_nm;
    std::vector<Band> bands;
    bool polarised = true;

    bool on(Effects effect) const { return effects[static_cast<std::size_t>(effect)].on; }
};

/// Throws InputError for what cannot be rendered yet (biaxial stones).
Plan make_plan(const Scene& scene);

}  // namespace culet
