#pragma once
// Which effects a scene calls for, at which wavelengths, and what leaving one out may cost.

#include <array>
#include <string>
#include <vector>

#include "render/colour/colour.h"
#include "render/optics/band.h"
#include "render/scene/scene.h"
#include "render/work/price.h"

namespace culet {

struct EffectDecision {
    Effects effect = Effects::dispersion;
    bool on = false;
    std::string why;
    /// Bound on the error of the radiance, relative to the largest light, of leaving it out; 0 when
    /// it is on or changes nothing. NaN: no bound is known (written as null).
    double error_bound = 0;
};

struct OpticalSetup {
    std::array<EffectDecision, k_effect_count> effects;
    std::vector<double> wavelengths_nm;
    /// Of each wavelength, where few stand for a coloured stone's whole spectrum, as the absorption
    /// of `bands` then does (few_wavelengths.h); else empty.
    std::vector<Rgb> rgb_weight;
    std::vector<Band> bands;
    bool polarised = true;
    bool stokes = false;   ///< all four Stokes parameters are needed: polarised lights, an analyser
    bool general = false;  ///< crystal_paths.h; else light_paths.h suffices
    bool splits = false;   ///< the stone has two waves, so that trees double
    int open_edges = 0;    ///< of a stone that is not convex

    bool on(Effects effect) const { return effects[static_cast<std::size_t>(effect)].on; }
    WavelengthSet colours() const {
        return rgb_weight.empty() ? WavelengthSet(wavelengths_nm)
                                  : WavelengthSet(wavelengths_nm, rgb_weight);
    }
};

/// Wavelengths that can be chosen from, coarse to fine; each set holds the one before.
constexpr std::array<int, 4> k_node_counts{8, 15, 29, 57};

/// `nodes`: wavelengths where a spectrum is called for and the scene names none.
OpticalSetup make_optical_setup(const Scene& scene, int nodes = k_node_counts[1]);

/// What a ray of one band costs, but for its counts.
PathWork work_along_paths(const OpticalSetup& setup);

/// True when the plan's wavelengths were its own choice of a spectrum.
bool chose_spectrum(const Scene& scene, const OpticalSetup& setup);

/// Whether a ray's paths are a tree, whose small branches are chosen at random.
bool paths_branch(const Scene& scene, const OpticalSetup& setup);
bool paths_branch(const Scene& scene);

}  // namespace culet
